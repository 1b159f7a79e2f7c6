#include "stages/track/given_poses.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sediment::track {
namespace {

void require_finite(const StampedPose& pose) {
  const Vec3& t = pose.world_from_camera.translation;
  bool finite = std::isfinite(pose.stamp_s) && std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.z);
  for (const double value : pose.world_from_camera.rotation) finite = finite && std::isfinite(value);
  if (!finite) throw std::runtime_error("the given pose at " + pose.stamp + " is not finite");
}

}  // namespace

std::vector<FrameTracking> resample(const Trajectory& given, const std::vector<std::string>& stamps,
                                    const std::vector<double>& stamps_s, double max_gap_s,
                                    Trajectory& poses) {
  for (const StampedPose& pose : given) require_finite(pose);
  poses.clear();
  std::vector<FrameTracking> frames;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    FrameTracking frame;
    frame.stamp = stamps[i];
    if (const auto pose = pose_at(given, stamps_s[i], max_gap_s)) {
      frame.state = TrackingState::tracked;
      frame.keyframe = true;
      frame.segment = 0;
      poses.push_back({stamps[i], stamps_s[i], *pose});
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

Gaps gaps_of(const Trajectory& given, double max_gap_s) {
  Gaps gaps;
  for (std::size_t i = 1; i < given.size(); ++i) {
    const double gap_s = given[i].stamp_s - given[i - 1].stamp_s;
    if (gap_s <= max_gap_s) continue;
    ++gaps.count;
    gaps.longest_s = std::max(gaps.longest_s, gap_s);
  }
  return gaps;
}

}  // namespace sediment::track
