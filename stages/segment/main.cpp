#include <chrono>
#include <cstdio>

#include "pipeline/artifacts/masks.hpp"
#include "pipeline/contract/progress.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/segment/segment_sequence.hpp"

using namespace sediment;
using namespace sediment::contract;
using segment::Engine, segment::Missing, segment::Unknown;

namespace {

std::optional<std::filesystem::path> path_of(const Work& work, const std::string& role) {
  return work.has(role) ? std::optional(work.in(role)) : std::nullopt;
}

/// To the log, never to the artifact: times differ from run to run.
void report_speed(const segment::MaskSource& source, std::size_t frames, int threads, double elapsed_s) {
  std::fprintf(stderr,
               "segment: %s, %zu frames, %.1f frames/s on %d threads, %.0f %% of their time in the network\n",
               source.engine().c_str(), frames, static_cast<double>(frames) / elapsed_s, threads,
               100 * source.inference_s() / (elapsed_s * threads));
}

Json to_json(const segment::Counts& counts, const segment::MaskSource& source) {
  return {{"engine", source.engine()},
          {"frames", counts.frames},
          {"frames_missing", source.missing()},
          {"frames_without_instances", counts.frames_without_instances},
          {"frames_without_person", counts.frames_without_person},
          {"instances", counts.instances},
          {"instances_per_class", counts.instances_per_class},
          {"masked_share", static_cast<double>(counts.masked_pixels) / static_cast<double>(counts.pixels)}};
}

void declare_parameters(Stage& stage, segment::Parameters& parameters) {
  stage.tunes("engine", parameters.engine,
              "auto: given if there are masks and no model, else onnxruntime if it is built in, else opencv",
              {{"auto", Engine::automatic},
               {"onnxruntime", Engine::onnxruntime},
               {"opencv", Engine::opencv},
               {"given", Engine::given}});
  stage.tunes("confidence", parameters.confidence, "lowest score of a detection, exclusive", {0, 1});
  stage.tunes("class_confidence", parameters.class_confidence,
              "CLASS=NUMBER,...: instead of --confidence for these classes");
  stage.tunes("classes", parameters.classes, "classes to keep, all if none is named");
  stage.tunes("iou", parameters.iou, "overlap of boxes of one class above which the weaker one goes", {0, 1});
  stage.tunes("max_detections", parameters.max_detections, "per frame, best first", {1, 65535});
  stage.tunes("input_size", parameters.input_size,
              "longer side in pixels of a network with a dynamic input, 0: as its metadata says", {0, 16384});
  stage.tunes("class_names", parameters.class_names,
              "names of the network's classes in order, if its metadata has none");
  stage.tunes("missing", parameters.missing, "a frame without a given mask is an error, or empty",
              {{"error", Missing::error}, {"empty", Missing::empty}});
  stage.tunes("unknown_classes", parameters.unknown_classes,
              "a given class that the label table does not know is an error, or kept",
              {{"error", Unknown::error}, {"keep", Unknown::keep}});
  stage.tunes("given_class", parameters.given_class, "class of the pixels in given binary images");
}

}  // namespace

int main(int argc, char** argv) {
  segment::Parameters parameters;
  Stage stage("segment",
              "Finds the objects in every colour image of a sequence: a mask, a class and a score each");
  stage.reads("sequence", kind::kSequence, "the colour images");
  stage.reads_optional("model", kind::kFile, "YOLOv8-seg or YOLO11-seg network exported to ONNX");
  stage.reads_optional("masks", kind::kFile,
                       "masks of one's own: a folder of ours, of binary PNGs, or a COCO file");
  stage.writes("masks", kind::kMasks, "instance ids per pixel, classes and scores");
  declare_parameters(stage, parameters);
  return stage.run(argc, argv, [&](Work& work) {
    const Sequence sequence = Sequence::open(work.in("sequence"));
    const auto source =
        segment::open_source(parameters, sequence, path_of(work, "model"), path_of(work, "masks"));
    MasksWriter writer(work.out());
    const auto started = std::chrono::steady_clock::now();
    segment::Counts counts;
    {
      Progress progress("segment", sequence.size(), "frames");
      counts = segment_sequence(*source, sequence.size(), work.threads(),
                                [&](std::size_t frame_idx, const InstanceMask& mask) {
                                  writer.write(sequence.entry(frame_idx).stamp, mask);
                                  progress.advance();
                                });
    }
    writer.finish();
    work.metrics() = to_json(counts, *source);
    report_speed(*source, sequence.size(), work.threads(),
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count());
  });
}
