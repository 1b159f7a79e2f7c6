#include "pipeline/scene/trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace sediment {
namespace {

std::size_t first_not_before(const Trajectory& trajectory, double stamp_s) {
  const auto found = std::lower_bound(trajectory.begin(), trajectory.end(), stamp_s,
                                      [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
  return static_cast<std::size_t>(found - trajectory.begin());
}

}  // namespace

std::optional<std::size_t> nearest_pose(const Trajectory& trajectory, double stamp_s, double tolerance_s) {
  if (trajectory.empty()) return std::nullopt;
  std::size_t best = std::min(first_not_before(trajectory, stamp_s), trajectory.size() - 1);
  if (best > 0 &&
      std::abs(trajectory[best - 1].stamp_s - stamp_s) < std::abs(trajectory[best].stamp_s - stamp_s))
    --best;
  if (std::abs(trajectory[best].stamp_s - stamp_s) > tolerance_s) return std::nullopt;
  return best;
}

std::optional<Pose> pose_at(const Trajectory& trajectory, double stamp_s, double max_gap_s) {
  const std::size_t next = first_not_before(trajectory, stamp_s);
  if (next == trajectory.size()) return std::nullopt;
  const StampedPose& after = trajectory[next];
  if (after.stamp_s == stamp_s) return after.world_from_camera;
  if (next == 0) return std::nullopt;
  const StampedPose& before = trajectory[next - 1];
  const double gap_s = after.stamp_s - before.stamp_s;
  if (gap_s > max_gap_s) return std::nullopt;
  return interpolate(before.world_from_camera, after.world_from_camera, (stamp_s - before.stamp_s) / gap_s);
}

}  // namespace sediment
