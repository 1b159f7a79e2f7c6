#include <cstdio>

#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/interaction-mask/mask_sequence.hpp"

using namespace sediment;
using namespace sediment::interaction_mask;

int main(int argc, char** argv) {
  Parameters parameters;
  contract::Stage stage("interaction-mask", "Finds what moves: people, and the things that they touch");
  stage.reads("sequence", contract::kind::kSequence, "depth images");
  stage.reads("masks", contract::kind::kMasks, "instances of every frame");
  stage.reads_optional(
      "labels", contract::kind::kFile,
      "label table (YAML) that says which classes move by themselves; default: the one built in");
  stage.writes("dynamic", contract::kind::kDynamicMasks, "0 static, 1 prior dynamic, 2 non-prior dynamic");
  stage.tunes("radius_px", parameters.touch.radius_px, "reach of a pixel pair, 6 in the paper", {0, 100});
  stage.tunes("threshold_m", parameters.touch.threshold_m,
              "touching below this mean depth difference (delta of section 3.2, not given in the paper)",
              {0, 100});
  stage.tunes("min_pairs", parameters.touch.min_pairs, "fewer pixel pairs decide nothing", {1, 1e9});
  stage.tunes("immovable", parameters.touch.immovable, "classes that no touch sets in motion");
  stage.tunes("motion", parameters.motion,
              "what is touched is dynamic only while it moves; needs masks of the stage repair");
  stage.tunes("start_m_s", parameters.motions.start_m_s, "moving for certain above this speed", {0, 100});
  stage.tunes("stop_m_s", parameters.motions.stop_m_s, "at rest below this speed", {0, 100});
  stage.tunes("min_frames", parameters.motions.min_frames, "frames that a motion has above start_m_s",
              {1, 1000});
  stage.tunes("memory", parameters.motions.memory, "frames between a touch and the motion that belongs to it",
              {0, 10000});
  stage.tunes("margin", parameters.motions.margin, "frames more on either side of a motion", {0, 1000});
  stage.tunes("halo_px", parameters.halo_px, "width of the seam of mixed depth that joins what moves",
              {0, 50});
  stage.tunes("preview", parameters.preview, "also write preview/STAMP.png: depth, prior mask, final mask");

  return stage.run(argc, argv, [&](contract::Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    const LabelTable labels = work.has("labels") ? read_labels(work.in("labels")) : default_labels();
    contract::Progress progress("interaction-mask", sequence.size(), "frames");
    const Counts counts = mask_sequence(sequence, work.in("masks"), labels, parameters, work.out(),
                                        [&] { progress.advance(); });
    if (counts.speeds_unknown)
      std::fprintf(stderr,
                   "interaction-mask: motion: no object has a speed (frames too far apart in time, or masks "
                   "that the stage repair has not made): what is touched is dynamic, as in the paper\n");
    work.metrics() = {{"frames", sequence.size()},
                      {"prior_dynamic_instances", counts.prior_dynamic_instances},
                      {"non_prior_dynamic_instances", counts.non_prior_dynamic_instances},
                      {"pairs_in_reach", counts.pairs_in_reach},
                      {"pairs_interacting", counts.pairs_interacting},
                      {"dynamic_pixels", counts.dynamic_pixels},
                      {"speeds_unknown", counts.speeds_unknown},
                      {"instances_of_unlisted_classes", counts.unlisted_classes}};
  });
}
