#include <tbb/parallel_for.h>

#include <map>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/interaction-mask/dynamic_mask.hpp"
#include "stages/interaction-mask/preview.hpp"

using namespace sediment;
using namespace sediment::interaction_mask;

namespace {

std::vector<Interaction> interactions_of(const ClassifiedFrame& frame, const InstanceMask& mask) {
  std::map<int, std::string> class_of;
  for (const Instance& instance : mask.instances) class_of[instance.id] = instance.class_name;
  std::vector<Interaction> interactions;
  for (const PairTest& pair : frame.pairs)
    interactions.push_back({pair.dynamic_id, pair.static_id, class_of[pair.dynamic_id],
                            class_of[pair.static_id], pair.pixel_pairs, pair.mean_depth_difference_m,
                            pair.interacting});
  return interactions;
}

/// Counts over all frames, added in order of the frames.
contract::Json metrics_of(const std::vector<ClassifiedFrame>& frames) {
  std::uint64_t prior = 0, non_prior = 0, in_reach = 0, interacting = 0, dynamic_pixels = 0;
  std::map<std::string, int> unlisted;
  for (const ClassifiedFrame& frame : frames) {
    prior += frame.prior_dynamic;
    non_prior += frame.non_prior_dynamic;
    in_reach += frame.pairs.size();
    for (const PairTest& pair : frame.pairs) interacting += pair.interacting;
    dynamic_pixels += frame.dynamic_pixels;
    for (const std::string& name : frame.unlisted) ++unlisted[name];
  }
  return {{"frames", frames.size()},
          {"prior_dynamic_instances", prior},
          {"non_prior_dynamic_instances", non_prior},
          {"pairs_in_reach", in_reach},
          {"pairs_interacting", interacting},
          {"dynamic_pixels", dynamic_pixels},
          {"instances_of_unlisted_classes", unlisted}};
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  bool preview = false;
  contract::Stage stage("interaction-mask", "Finds what moves: people, and the things that they touch");
  stage.reads("sequence", contract::kind::kSequence, "depth images");
  stage.reads("masks", contract::kind::kMasks, "instances of every frame");
  stage.reads_optional(
      "labels", contract::kind::kFile,
      "label table (YAML) that says which classes move by themselves; default: the one built in");
  stage.writes("dynamic", contract::kind::kDynamicMasks, "0 static, 1 prior dynamic, 2 non-prior dynamic");
  stage.tunes("radius_px", parameters.radius_px, "reach of a pixel pair, 6 in the paper", {0, 100});
  stage.tunes("threshold_m", parameters.threshold_m,
              "touching below this mean depth difference (delta of section 3.2, not given in the paper)",
              {0, 100});
  stage.tunes("min_pairs", parameters.min_pairs, "fewer pixel pairs decide nothing", {1, 1e9});
  stage.tunes("immovable", parameters.immovable, "classes that no touch sets in motion");
  stage.tunes("preview", preview, "also write preview/STAMP.png: depth, prior mask, final mask");

  return stage.run(argc, argv, [&](contract::Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    const MasksReader masks(work.in("masks"));
    const LabelTable labels = work.has("labels") ? read_labels(work.in("labels")) : default_labels();
    DynamicMasksWriter writer(work.out());
    if (preview) std::filesystem::create_directories(work.out() / "preview");

    std::vector<ClassifiedFrame> frames(sequence.size());
    contract::Progress progress("interaction-mask", sequence.size(), "frames");
    tbb::parallel_for(std::size_t{0}, sequence.size(), [&](std::size_t i) {
      const std::string& stamp = sequence.entry(i).stamp;
      const InstanceMask mask = masks.read(stamp);
      const cv::Mat depth = sequence.depth(i);
      try {
        frames[i] = classify(mask, depth, sequence.camera().depth_scale, labels, parameters);
      } catch (const std::invalid_argument& error) {
        throw std::runtime_error(work.in("masks").string() + ": frame " + stamp + ": " + error.what());
      }
      writer.write(stamp, frames[i].dynamic, interactions_of(frames[i], mask));
      if (preview)
        write_png(work.out() / "preview" / (stamp + ".png"),
                  preview_of(sequence.color(i), depth, sequence.camera().depth_scale, frames[i].dynamic));
      frames[i].dynamic.release();
      progress.advance();
    });
    writer.finish();
    work.metrics() = metrics_of(frames);
  });
}
