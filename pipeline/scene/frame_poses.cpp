#include "pipeline/scene/frame_poses.hpp"

namespace sediment {

FramePoses::FramePoses(std::span<const FrameStamp> frames, const Trajectory& trajectory)
    : trajectory_(trajectory) {
  for (std::size_t i = 0; i < trajectory.size(); ++i) pose_by_stamp_.emplace(trajectory[i].stamp, i);
  for (const FrameStamp& frame : frames) stamps_.insert(frame.stamp);
}

std::optional<Pose> FramePoses::pose_of(const FrameStamp& frame) const {
  if (const auto same = pose_by_stamp_.find(frame.stamp); same != pose_by_stamp_.end())
    return trajectory_[same->second].world_from_camera;
  if (const auto between = pose_at(trajectory_, frame.stamp_s, kLongestGap_s)) return between;
  const auto nearest = nearest_pose(trajectory_, frame.stamp_s, kTolerance_s);
  if (nearest && !stamps_.contains(trajectory_[*nearest].stamp))
    return trajectory_[*nearest].world_from_camera;
  return std::nullopt;
}

}  // namespace sediment
