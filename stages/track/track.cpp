#include "stages/track/track.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "stages/track/completion.hpp"
#include "stages/track/map_adjustment.hpp"
#include "stages/track/tracker.hpp"

namespace sediment::track {
namespace {

using Features = std::shared_ptr<const FrameFeatures>;

void require_forward_time(const Recording& recording) {
  for (std::size_t i = 1; i < recording.stamps_s.size(); ++i)
    if (!(recording.stamps_s[i] > recording.stamps_s[i - 1]))
      throw std::runtime_error("frame " + std::to_string(i) + " (" + recording.stamps[i] +
                               ") is not later than the one before (" + recording.stamps[i - 1] + ")");
}

Features features_of(const Recording& recording, const Parameters& parameters, std::size_t frame_idx) {
  const Frame frame = recording.frame(frame_idx);
  const cv::Mat mask = recording.dynamic_mask ? recording.dynamic_mask(frame_idx) : cv::Mat();
  cv::Mat gray;
  cv::cvtColor(frame.color, gray, cv::COLOR_BGR2GRAY);
  return std::make_shared<const FrameFeatures>(
      extract_features(gray, frame.depth, mask, recording.camera, parameters));
}

// Features of coming frames are found while earlier ones are tracked, one by one and in order.
void run_front_end(const Recording& recording, const Parameters& parameters,
                   const std::function<void()>& advance, Tracker& tracker) {
  const std::size_t in_flight = 2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 2;
  std::size_t next = 0;
  const auto read = tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                                        [&](tbb::flow_control& control) -> std::size_t {
                                                          if (next == recording.stamps.size()) control.stop();
                                                          return next++;
                                                        });
  const auto extract = tbb::make_filter<std::size_t, Features>(
      tbb::filter_mode::parallel,
      [&](std::size_t frame_idx) { return features_of(recording, parameters, frame_idx); });
  std::size_t tracked = 0;
  const auto follow =
      tbb::make_filter<Features, void>(tbb::filter_mode::serial_in_order, [&](Features features) {
        tracker.track(recording.stamps_s[tracked++], std::move(features));
        if (advance) advance();
      });
  tbb::parallel_pipeline(in_flight, read & extract & follow);
}

Tracked collect(const Recording& recording, Tracker& tracker) {
  Tracked result;
  Pose world_from_map;
  for (std::size_t i = 0; i < tracker.frames().size(); ++i) {
    const TrackedFrame& frame = tracker.frames()[i];
    FrameTracking entry;
    entry.stamp = recording.stamps[i];
    if (frame.tracked) {
      const Pose pose = camera_from_world(frame, tracker.map()).inverse();
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
  return result;
}

}  // namespace

Tracked track(const Recording& recording, const Parameters& parameters,
              const std::function<void()>& advance) {
  require_forward_time(recording);
  const Pinhole pinhole = pinhole_of(recording.camera, parameters);
  Tracker tracker(pinhole, parameters);
  run_front_end(recording, parameters, advance, tracker);
  if (tracker.map().keyframes.size() > 1) adjust_all(tracker.map(), pinhole);
  refine_frames(tracker, pinhole);
  return collect(recording, tracker);
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
