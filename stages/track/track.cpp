#include "stages/track/track.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "stages/track/completion.hpp"
#include "stages/track/loop_closing.hpp"
#include "stages/track/map_adjustment.hpp"
#include "stages/track/tracker.hpp"

namespace sediment::track {
namespace {

void require_forward_time(const Recording& recording) {
  for (std::size_t i = 1; i < recording.stamps_s.size(); ++i)
    if (!(recording.stamps_s[i] > recording.stamps_s[i - 1]))
      throw std::runtime_error("frame " + std::to_string(i) + " (" + recording.stamps[i] +
                               ") is not later than the one before (" + recording.stamps[i - 1] + ")");
}

double depth_delay_s(const Recording& recording, std::size_t frame_idx) {
  return recording.depth_stamps_s.empty()
             ? 0
             : recording.depth_stamps_s[frame_idx] - recording.stamps_s[frame_idx];
}

// What tracking needs of a frame, found in its images.
View found_view(const Recording& recording, const Parameters& parameters, const DenseCamera& dense_camera,
                std::size_t frame_idx) {
  const Frame frame = recording.frame(frame_idx);
  const cv::Mat mask = recording.dynamic_mask ? recording.dynamic_mask(frame_idx) : cv::Mat();
  const cv::Mat allowed = allowed_pixels(mask, parameters.mask_halo_px);
  cv::Mat gray;
  cv::cvtColor(frame.color, gray, cv::COLOR_BGR2GRAY);
  View view;
  view.features = std::make_shared<const FrameFeatures>(
      measured_features(find_features(gray, allowed, recording.camera, parameters), frame.depth,
                        recording.camera, {}, parameters));
  view.dense = std::make_shared<const DenseFrame>(
      dense_frame(gray, frame.depth, allowed, dense_camera, parameters.depth_noise));
  return view;
}

// What a pass has learned about the frames, for the next one.
struct Hindsight {
  std::vector<std::shared_ptr<const FrameFeatures>> features;
  std::vector<std::shared_ptr<const DenseFrame>> dense;
  std::vector<Motion> motions;
  SensorTiming timing;
};

std::shared_ptr<const FrameFeatures> corrected_features(const Recording& recording,
                                                        const Parameters& parameters,
                                                        const Hindsight& hindsight, std::size_t frame_idx) {
  const Exposure exposure{hindsight.motions[frame_idx], hindsight.timing,
                          depth_delay_s(recording, frame_idx)};
  const cv::Mat depth = recording.depth ? recording.depth(frame_idx) : recording.frame(frame_idx).depth;
  return std::make_shared<const FrameFeatures>(
      measured_features(*hindsight.features[frame_idx], depth, recording.camera, exposure, parameters));
}

// Views of coming frames are made while earlier ones are tracked, one by one and in order.
void run_front_end(const Recording& recording, const std::function<View(std::size_t)>& view_of,
                   const std::function<void()>& advance, Tracker& tracker) {
  const std::size_t in_flight = 2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 2;
  std::size_t next = 0;
  const auto read = tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                                        [&](tbb::flow_control& control) -> std::size_t {
                                                          if (next == recording.stamps.size()) control.stop();
                                                          return next++;
                                                        });
  const auto view = tbb::make_filter<std::size_t, View>(tbb::filter_mode::parallel, view_of);
  std::size_t tracked = 0;
  const auto follow = tbb::make_filter<View, void>(tbb::filter_mode::serial_in_order, [&](const View& v) {
    tracker.track(recording.stamps_s[tracked++], v);
    if (advance) advance();
  });
  tbb::parallel_pipeline(in_flight, read & view & follow);
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
    hindsight.dense.push_back(frame.dense);
    if (!frame.tracked) continue;
    poses[i] = camera_from_world(frame, tracker.map()).inverse();
    known[i] = &poses[i];
  }
  hindsight.motions = motions_of(recording.stamps_s, known, kMaxGap_s);
  return hindsight;
}

// The segment with most frames: where others are in its world nobody knows.
int largest_segment(Tracker& tracker) {
  std::vector<int> frames_of(tracker.map().keyframes.size() + 1, 0);
  for (const TrackedFrame& frame : tracker.frames())
    if (frame.tracked) ++frames_of[tracker.map().keyframes[frame.reference_idx].segment];
  return static_cast<int>(std::max_element(frames_of.begin(), frames_of.end()) - frames_of.begin());
}

Tracked collect(const Recording& recording, Tracker& tracker, Mode mode) {
  Tracked result;
  Pose world_from_map;
  const int segment = largest_segment(tracker);
  for (std::size_t i = 0; i < tracker.frames().size(); ++i) {
    const TrackedFrame& frame = tracker.frames()[i];
    FrameTracking entry;
    entry.stamp = recording.stamps[i];
    if (frame.tracked && tracker.map().keyframes[frame.reference_idx].segment == segment) {
      const Pose pose = mode == Mode::causal ? frame.world_from_camera_then
                                             : camera_from_world(frame, tracker.map()).inverse();
      if (result.poses.empty()) world_from_map = pose.inverse();
      result.poses.push_back({recording.stamps[i], recording.stamps_s[i], world_from_map * pose});
      entry.state = TrackingState::tracked;
      entry.keyframe = frame.keyframe;
      entry.matches = frame.matches;
      entry.inliers = frame.inliers;
      entry.residual_px = frame.residual_px;
    }
    result.frames.push_back(std::move(entry));
  }
  for (const MapPoint& point : tracker.map().points) result.landmarks += !point.removed;
  std::vector<char> segments(tracker.map().keyframes.size(), 0);
  for (const Keyframe& keyframe : tracker.map().keyframes)
    result.segments += !std::exchange(segments[keyframe.segment], 1);
  return result;
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

}  // namespace

Tracked track(const Recording& recording, const Parameters& parameters,
              const std::function<void()>& advance) {
  require_forward_time(recording);
  const Pinhole pinhole = pinhole_of(recording.camera, parameters);
  const DenseCamera dense_camera(recording.camera);
  Tracker tracker(pinhole, dense_camera, parameters);
  run_front_end(
      recording, [&](std::size_t i) { return found_view(recording, parameters, dense_camera, i); }, advance,
      tracker);
  if (parameters.mode == Mode::causal) return collect(recording, tracker, Mode::causal);
  SensorTiming timing;
  LoopClosing closing;
  if (tracker.map().keyframes.size() > 1) {
    closing = close_loops(tracker.map(), pinhole, dense_camera, parameters.depth_noise);
    measure_again(recording, parameters, timing, true, tracker);
    timing = adjust_all(tracker.map(), pinhole, timing);
    if (worth_another_pass(recording, learn(recording, tracker, timing))) {
      for (int pass = 1; pass < parameters.passes; ++pass) {
        measure_again(recording, parameters, timing, true, tracker);
        match_again(tracker.map(), pinhole);
        timing = adjust_all(tracker.map(), pinhole, timing);
      }
      measure_again(recording, parameters, timing, false, tracker);
    }
  }
  find_lost_frames(tracker, pinhole);
  refine_frames(tracker, pinhole);
  Tracked result = collect(recording, tracker, Mode::offline);
  result.timing = timing;
  result.loops = closing.loops;
  return result;
}

double coverage(const std::vector<FrameTracking>& frames) {
  if (frames.empty()) return 0;
  const auto tracked = std::count_if(frames.begin(), frames.end(), [](const FrameTracking& frame) {
    return frame.state == TrackingState::tracked;
  });
  return static_cast<double>(tracked) / static_cast<double>(frames.size());
}

void require_coverage(const std::vector<FrameTracking>& frames, double min_coverage) {
  if (coverage(frames) >= min_coverage) return;
  std::size_t lost = 0;
  std::string first;
  for (const FrameTracking& frame : frames)
    if (frame.state == TrackingState::lost && lost++ == 0) first = frame.stamp;
  throw std::runtime_error(
      "lost " + std::to_string(lost) + " of " + std::to_string(frames.size()) + " frames, the first at " +
      first + ": less than the coverage asked for (min_coverage " + std::to_string(min_coverage) + ")");
}

}  // namespace sediment::track
