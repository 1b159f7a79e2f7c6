#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/scene/pose.hpp"

namespace sediment {

/// A camera pose at a time.
struct StampedPose {
  std::string stamp;  ///< as written in the file it came from: names files, joins tables
  double stamp_s = 0;
  Pose world_from_camera;
};

/// Poses in order of time.
using Trajectory = std::vector<StampedPose>;

/// State of one frame after tracking.
enum class TrackingState { tracked, lost };

/// What tracking says of one frame of a sequence.
struct FrameTracking {
  std::string stamp;
  TrackingState state = TrackingState::lost;
  bool keyframe = false;
  int matches = 0;         ///< correspondences with the map tried in the last pose estimation
  int inliers = 0;         ///< of those, the ones that fit
  double residual_px = 0;  ///< root mean square reprojection error of the inliers
  /// Which world its pose is of: 0 that of the trajectory, others are parts of the recording that could not
  /// be joined to it (their frames are lost to it); -1 none.
  int segment = -1;
};

/// Index of the pose nearest in time to `stamp_s`, none if it is further away than `tolerance_s`.
std::optional<std::size_t> nearest_pose(const Trajectory& trajectory, double stamp_s, double tolerance_s);

/// The pose at a time, interpolated between its neighbours; none outside the trajectory or within a gap
/// between neighbours longer than `max_gap_s`.
std::optional<Pose> pose_at(const Trajectory& trajectory, double stamp_s, double max_gap_s);

}  // namespace sediment
