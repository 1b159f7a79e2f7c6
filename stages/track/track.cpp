#include "stages/track/track.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "stages/track/collection.hpp"
#include "stages/track/completion.hpp"
#include "stages/track/diagnosis.hpp"
#include "stages/track/finished_map.hpp"
#include "stages/track/loop_closing.hpp"
#include "stages/track/tracker.hpp"

namespace sediment::track {
namespace {

void require_forward_time(const Recording& recording) {
  for (std::size_t i = 1; i < recording.stamps_s.size(); ++i)
    if (!(recording.stamps_s[i] > recording.stamps_s[i - 1]))
      throw std::runtime_error("frame " + std::to_string(i) + " (" + recording.stamps[i] +
                               ") is not later than the one before (" + recording.stamps[i - 1] + ")");
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
  const auto found = [&](const cv::Mat& where, int wanted) {
    return std::make_shared<const FrameFeatures>(measured_features(
        find_features(gray, where, recording.camera, wanted), frame.depth, recording.camera, {}, parameters));
  };
  view.features = found(allowed, parameters.features);
  if (parameters.still_features && parameters.mode == Mode::offline && !allowed.empty()) {
    const cv::Mat dynamic = 255 - allowed;
    const double share =
        static_cast<double>(cv::countNonZero(dynamic)) / static_cast<double>(dynamic.total());
    if (share > 0) view.waiting = found(dynamic, static_cast<int>(std::lround(share * parameters.features)));
  }
  view.dense = std::make_shared<const DenseFrame>(
      dense_frame(gray, frame.depth, allowed, dense_camera, parameters.depth_noise));
  return view;
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
  if (parameters.mode == Mode::causal) {
    Tracked result = collect(recording, tracker, Mode::causal);
    result.diagnosis = diagnose(tracker.map(), pinhole);
    return result;
  }
  LoopClosing closing;
  FinishedMap finished;
  if (tracker.map().keyframes.size() > 1) {
    closing = close_loops(tracker.map(), pinhole, dense_camera, parameters.depth_noise);
    finished = finish_map(recording, parameters, pinhole, tracker);
  }
  find_lost_frames(tracker, pinhole);
  refine_frames(tracker, pinhole, dense_camera, parameters.depth_noise);
  if (parameters.smoothing) smooth_frames(tracker);
  Tracked result = collect(recording, tracker, Mode::offline);
  result.diagnosis = diagnose(tracker.map(), pinhole);
  result.timing = finished.timing;
  result.loops = closing.loops;
  result.still_landmarks = finished.still_landmarks;
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
