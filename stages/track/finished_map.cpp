#include "stages/track/finished_map.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "stages/track/completion.hpp"
#include "stages/track/map_adjustment.hpp"
#include "stages/track/still_features.hpp"

namespace sediment::track {
namespace {

double depth_delay_s(const Recording& recording, std::size_t frame_idx) {
  return recording.depth_stamps_s.empty()
             ? 0
             : recording.depth_stamps_s[frame_idx] - recording.stamps_s[frame_idx];
}

cv::Mat depth_of(const Recording& recording, std::size_t frame_idx) {
  return recording.depth ? recording.depth(frame_idx) : recording.frame(frame_idx).depth;
}

// The recording with a memory for depth images, which all passes measure keyframes in: as many as fit.
// Afterwards and for other frames they are read.
Recording remembering_depth(const Recording& recording) {
  constexpr std::ptrdiff_t kMost_bytes = std::ptrdiff_t{256} << 20;
  struct Memory {
    std::vector<cv::Mat> depth;  // per frame, each asked for by one thread at a time
    std::atomic<std::ptrdiff_t> free_bytes = kMost_bytes;
  };
  const auto memory = std::make_shared<Memory>();
  memory->depth.resize(recording.stamps.size());
  Recording remembering = recording;
  remembering.depth = [&recording, memory](std::size_t i) {
    cv::Mat& kept = memory->depth[i];
    if (!kept.empty()) return kept;
    cv::Mat depth = depth_of(recording, i);
    const auto bytes = static_cast<std::ptrdiff_t>(depth.total() * depth.elemSize());
    if ((memory->free_bytes -= bytes) >= 0) kept = depth;
    return depth;
  };
  return remembering;
}

// What a pass has learned about the frames, for the next one.
struct Hindsight {
  std::vector<std::shared_ptr<const FrameFeatures>> features;
  std::vector<Motion> motions;
  SensorTiming timing;
};

std::shared_ptr<const FrameFeatures> corrected_features(const Recording& recording,
                                                        const Parameters& parameters,
                                                        const Hindsight& hindsight, std::size_t frame_idx) {
  const Exposure exposure{hindsight.motions[frame_idx], hindsight.timing,
                          depth_delay_s(recording, frame_idx)};
  return std::make_shared<const FrameFeatures>(measured_features(*hindsight.features[frame_idx],
                                                                 depth_of(recording, frame_idx),
                                                                 recording.camera, exposure, parameters));
}

Hindsight learn(const Recording& recording, Tracker& tracker, const SensorTiming& timing) {
  constexpr double kMaxGap_s = 0.11;
  Hindsight hindsight;
  hindsight.timing = timing;
  std::vector<Pose> poses(tracker.frames().size());
  std::vector<const Pose*> known(poses.size(), nullptr);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const TrackedFrame& frame = tracker.frames()[i];
    hindsight.features.push_back(frame.features);
    if (!frame.tracked) continue;
    poses[i] = camera_from_world(frame, tracker.map()).inverse();
    known[i] = &poses[i];
  }
  hindsight.motions = motions_of(recording.stamps_s, known, kMaxGap_s);
  return hindsight;
}

void share_with_keyframes(Tracker& tracker) {
  for (Keyframe& keyframe : tracker.map().keyframes)
    keyframe.features = tracker.frames()[keyframe.frame_idx].features;
}

// Measures features again with what the poses tell of the camera's motion: of the keyframes, or of the
// others.
void measure_again(const Recording& recording, const Parameters& parameters, const SensorTiming& timing,
                   bool keyframes, Tracker& tracker) {
  const Hindsight hindsight = learn(recording, tracker, timing);
  tbb::parallel_for(std::size_t{0}, tracker.frames().size(), [&](std::size_t i) {
    TrackedFrame& frame = tracker.frames()[i];
    if (frame.keyframe == keyframes) frame.features = corrected_features(recording, parameters, hindsight, i);
  });
  share_with_keyframes(tracker);
}

// Whether what was learned moves measurements by so much that the recording is worth another pass: by more
// than half a pixel in a tenth of the frames.
bool worth_another_pass(const Recording& recording, const Hindsight& hindsight) {
  constexpr double kShift_px = 0.5, kShare = 0.1;
  std::size_t moved_far = 0;
  for (std::size_t i = 0; i < hindsight.motions.size(); ++i) {
    const SensorTiming& timing = hindsight.timing;
    const double time_s =
        0.5 * std::abs(timing.readout_s) + std::abs(timing.depth_lag_s + depth_delay_s(recording, i));
    moved_far += norm(hindsight.motions[i].angular_rad_s) * recording.camera.fx * time_s > kShift_px;
  }
  return static_cast<double>(moved_far) > kShare * static_cast<double>(hindsight.motions.size());
}

bool is_settled(const SensorTiming& before, const SensorTiming& after) {
  constexpr double kNothing_s = 3e-4;
  return std::abs(after.readout_s - before.readout_s) < kNothing_s &&
         std::abs(after.depth_lag_s - before.depth_lag_s) < kNothing_s;
}

// Measures and adjusts until the timing stays the same: what fits badly under a wrong timing is put aside, so
// that one adjustment does not find all of it. Keyframes are measured with the last timing but for what it
// still changed.
SensorTiming settle_timing(const Recording& recording, const Parameters& parameters, const Pinhole& pinhole,
                           SensorTiming timing, Tracker& tracker) {
  constexpr double kLongest_s = 1.0 / 30;
  for (int pass = 1; pass < parameters.passes; ++pass) {
    measure_again(recording, parameters, timing, true, tracker);
    match_again(tracker.map(), pinhole);
    const SensorTiming before = std::exchange(timing, adjust_all(tracker.map(), pinhole, timing));
    if (is_settled(before, timing)) break;
    // How fast depth changes is measured with noise itself, which makes the adjustment ask for half of the
    // lag.
    if (pass + 1 < parameters.passes) timing.depth_lag_s += timing.depth_lag_s - before.depth_lag_s;
    // No camera takes longer than a frame: more is a mistake, which must not grow from pass to pass.
    timing.readout_s = std::clamp(timing.readout_s, -kLongest_s, kLongest_s);
    timing.depth_lag_s = std::clamp(timing.depth_lag_s, -kLongest_s, kLongest_s);
  }
  return timing;
}

}  // namespace

FinishedMap finish_map(const Recording& recording, const Parameters& parameters, const Pinhole& pinhole,
                       Tracker& tracker) {
  Map& map = tracker.map();
  FinishedMap finished;
  if (parameters.passes == 0) return finished;
  const Recording remembering = remembering_depth(recording);
  measure_again(remembering, parameters, {}, true, tracker);
  finished.timing = adjust_all(map, pinhole, {});
  const bool timed = worth_another_pass(recording, learn(recording, tracker, finished.timing));
  if (timed) finished.timing = settle_timing(remembering, parameters, pinhole, finished.timing, tracker);
  const auto waits = [](const TrackedFrame& frame) { return frame.waiting && frame.waiting->size() > 0; };
  if (std::any_of(tracker.frames().begin(), tracker.frames().end(), waits)) {
    const SensorTiming measured_with = timed ? finished.timing : SensorTiming{};
    const std::vector<std::size_t> trusted = join_waiting_features(tracker);
    measure_again(remembering, parameters, measured_with, true, tracker);
    finished.still_landmarks = admit_still_features(map, trusted, pinhole);
    finished.timing = adjust_all(map, pinhole, measured_with);
  }
  if (timed) measure_again(recording, parameters, finished.timing, false, tracker);
  return finished;
}

}  // namespace sediment::track
