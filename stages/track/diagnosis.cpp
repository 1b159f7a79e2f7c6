#include "stages/track/diagnosis.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "stages/track/residual.hpp"

namespace sediment::track {
namespace {

// Stretches of lost frames as "first .. last (count)".
std::string lost_stretches(const std::vector<FrameTracking>& frames) {
  std::string text;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t end = i;
    while (end < frames.size() && frames[end].state == TrackingState::lost) ++end;
    if (end > i)
      text += fmt::format("  {} .. {}: {} frames\n", frames[i].stamp, frames[end - 1].stamp, end - i);
    i = end + 1;
  }
  return text;
}

std::string weakest_frames(const std::vector<FrameTracking>& frames) {
  constexpr std::size_t kMost = 5;
  std::vector<const FrameTracking*> tracked;
  for (const FrameTracking& frame : frames)
    if (frame.state == TrackingState::tracked) tracked.push_back(&frame);
  std::stable_sort(tracked.begin(), tracked.end(),
                   [](const auto* a, const auto* b) { return a->inliers < b->inliers; });
  std::string text;
  for (std::size_t i = 0; i < tracked.size() && i < kMost; ++i)
    text += fmt::format("  {}: {} inliers of {} matches, {:.2f} px\n", tracked[i]->stamp, tracked[i]->inliers,
                        tracked[i]->matches, tracked[i]->residual_px);
  return text;
}

double path_length_m(const Trajectory& poses) {
  double length_m = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length_m += norm(poses[i].world_from_camera.translation - poses[i - 1].world_from_camera.translation);
  return length_m;
}

// The value below which this share of the values is; 0 of none. Changes the order of the values.
float quantile(std::vector<float>& values, double share) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

Diagnosis diagnose(const Map& map, const Pinhole& pinhole) {
  Diagnosis diagnosis;
  for (const Keyframe& keyframe : map.keyframes) {
    KeyframeFeatures shown;
    shown.frame_idx = static_cast<std::size_t>(keyframe.frame_idx);
    const Pose camera_from_world = keyframe.world_from_camera.inverse();
    for (std::size_t i = 0; i < keyframe.features->size(); ++i) {
      const Feature& feature = keyframe.features->feature(i);
      const int point_id = keyframe.point_ids[i];
      const bool held = point_id >= 0 && map.points[static_cast<std::size_t>(point_id)].sightings.size() > 1;
      shown.features.push_back({feature.seen_u_px, feature.seen_v_px, held});
      if (!held) continue;
      const Vec3 p = camera_from_world * map.points[static_cast<std::size_t>(point_id)].position;
      if (p.z < kProjectable_m) continue;
      const Measurement measured = measurement_of(feature, pinhole, keyframe.noise_scale);
      const auto r = residual_of(measured, pinhole, p);
      diagnosis.error_px.push_back(static_cast<float>(std::hypot(r[0], r[1]) / measured.pixel_weight));
      if (measured.inverse_depth > 0) diagnosis.depth_error.push_back(static_cast<float>(r[2]));
    }
    diagnosis.keyframes.push_back(std::move(shown));
  }
  return diagnosis;
}

std::string summary_of(const Tracked& tracked) {
  const std::size_t frames = tracked.frames.size();
  std::string text =
      fmt::format("{} of {} frames have a pose ({:.1f} %), over a path of {:.3f} m\n", tracked.poses.size(),
                  frames, 100 * coverage(tracked.frames), path_length_m(tracked.poses));
  if (const std::string lost = lost_stretches(tracked.frames); !lost.empty()) text += "lost:\n" + lost;
  const auto& diagnosis = tracked.diagnosis;
  text += fmt::format(
      "map: {} keyframes, {} landmarks ({} on dynamic pixels that hold still), {} loops closed, {} "
      "segment{}\n",
      diagnosis.keyframes.size(), tracked.landmarks, tracked.still_landmarks, tracked.loops, tracked.segments,
      tracked.segments == 1 ? "" : "s");
  text += fmt::format("sensor: the image is read out in {:.1f} ms, depth is {:.1f} ms later than its stamp\n",
                      1e3 * tracked.timing.readout_s, 1e3 * tracked.timing.depth_lag_s);
  std::vector<float> error_px = diagnosis.error_px, depth_error = diagnosis.depth_error;
  for (float& error : depth_error) error = std::abs(error);
  text += fmt::format(
      "fit of {} sightings in keyframes: reprojection error {:.2f} px in the median, {:.2f} px at 95 %; "
      "depth {:.2f} "
      "and {:.2f} standard deviations\n",
      error_px.size(), quantile(error_px, 0.5), quantile(error_px, 0.95), quantile(depth_error, 0.5),
      quantile(depth_error, 0.95));
  if (const std::string weakest = weakest_frames(tracked.frames); !weakest.empty())
    text += "frames with fewest inliers:\n" + weakest;
  return text;
}

}  // namespace sediment::track
