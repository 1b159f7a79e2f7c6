#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/repair/repair_sequence.hpp"

using namespace sediment;
using namespace sediment::repair;

int main(int argc, char** argv) {
  Parameters parameters;
  contract::Stage stage("repair", "Mends instance masks with what the frames before and after know");
  stage.reads("sequence", contract::kind::kSequence, "colour and depth images");
  stage.reads("masks", contract::kind::kMasks, "instances as each frame alone shows them");
  stage.reads_optional("labels", contract::kind::kFile,
                       "label table (YAML) that says which classes move by themselves; default: built in");
  stage.writes("masks", contract::kind::kMasks,
               "instances with an id, a class and a speed through the sequence");
  stage.tunes("max_gap", parameters.vote.max_gap,
              "frames over which a missed detection is repaired, 0: none is", {0, 100});
  stage.tunes("neighbors", parameters.vote.neighbors, "frames on either side that vote on each mask, 0: none",
              {0, 20});
  stage.tunes("min_detections", parameters.confirm.min_detections,
              "an object seen less often within max_gap is false if its neighbours contradict it, 1: never",
              {1, 100});
  stage.tunes("snap_px", parameters.snap.radius_px,
              "neighbourhood in which outlines move to edges of depth and colour, 0: they stay", {0, 50});
  stage.tunes("speeds", parameters.speeds, "measure how fast each instance moves");
  stage.tunes("longest_pause_s", parameters.longest_pause_s,
              "frames further apart know nothing of each other", {0, 10});

  return stage.run(argc, argv, [&](contract::Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    const MasksReader masks(work.in("masks"));
    const LabelTable labels = work.has("labels") ? read_labels(work.in("labels")) : default_labels();
    MasksWriter writer(work.out());
    contract::Progress progress("repair", sequence.size(), "frames");
    const Counts counts =
        repair_sequence(sequence, masks, labels, parameters, writer, [&] { progress.advance(); });
    work.metrics() = {{"frames", counts.frames},
                      {"detections", counts.detections},
                      {"detections_dropped", counts.detections_dropped},
                      {"classes_corrected", counts.classes_corrected},
                      {"instances_repaired", counts.instances_repaired},
                      {"objects", counts.objects},
                      {"frames_without_speeds", counts.frames_without_speeds}};
  });
}
