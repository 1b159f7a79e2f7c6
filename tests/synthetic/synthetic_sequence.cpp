#include "tests/synthetic/synthetic_sequence.hpp"

#include "pipeline/artifacts/label_file.hpp"
#include "tools/synthesize/degraded_masks.hpp"
#include "tools/synthesize/seen_surface.hpp"
#include "tools/synthesize/sequence_writer.hpp"

namespace sediment::test {
namespace {

synthetic::Recording recording_of(const SyntheticSettings& settings) {
  synthetic::Settings s;
  s.scene = settings.scene, s.seed = settings.seed, s.frames = settings.frames;
  s.width = settings.width, s.height = settings.height;
  s.noise = settings.noise, s.rate_hz = settings.rate_hz;
  return synthetic::Recording(s);
}

}  // namespace

SyntheticSequence synthetic_sequence(const SyntheticSettings& settings) {
  const synthetic::Recording recording = recording_of(settings);
  synthetic::SeenSurface surface(recording.scene(), synthetic::kCloudSpacing);
  const std::vector<bool> missed = synthetic::missed_frames(recording.size(), {}, settings.seed);
  SyntheticSequence sequence;
  sequence.camera = recording.camera();
  for (std::size_t i = 0; i < recording.size(); ++i) {
    synthetic::RecordedFrame f = recording.frame(i);
    surface.add(f.exact, f.moment, f.frame.depth);
    sequence.groundtruth.push_back({f.frame.stamp, f.frame.stamp_s, f.world_from_camera});
    if (settings.degraded)
      sequence.degraded.push_back(
          missed[i] ? InstanceMask{cv::Mat(f.instances.ids.size(), CV_16UC1, cv::Scalar(0)), {}}
                    : synthetic::degraded(f.instances, {}, settings.seed, i));
    sequence.instances.push_back(std::move(f.instances));
    sequence.dynamic.push_back(f.dynamic);
    sequence.exact_depth_m.push_back(f.exact.depth_m);
    sequence.frames.push_back(std::move(f.frame));
  }
  sequence.static_cloud = surface.cloud(recording.lighting(), default_labels());
  return sequence;
}

std::filesystem::path write_synthetic_sequence(const std::filesystem::path& folder,
                                               const SyntheticSettings& settings) {
  synthetic::write_recording(recording_of(settings), folder, {.degraded_masks = settings.degraded});
  return folder / "sequence.yaml";
}

}  // namespace sediment::test
