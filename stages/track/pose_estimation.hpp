#pragma once

#include <vector>

#include "pipeline/scene/pose.hpp"
#include "stages/track/residual.hpp"

namespace sediment::track {

/// A landmark and what the frame measured of it.
struct Correspondence {
  Vec3 point;  ///< world frame
  Measurement measurement;
};

struct PoseEstimate {
  Pose camera_from_world;
  std::vector<char> inlier;  ///< per correspondence
  int inliers = 0;
  double residual_px = 0;  ///< root mean square reprojection error of the inliers
  double noise_scale = 1;  ///< noise of the frame as a multiple of what the measurements promise, 1 .. 3
};

/// The pose that fits the correspondences best from a start nearby: Gauss-Newton with Huber weights over the
/// three-row residual, four rounds between which correspondences beyond the chi-square bound are set aside
/// and may come back (ORB-SLAM2's scheme). Blur and fast motion make a whole frame noisier than its
/// neighbours: the median residual scales the bounds, up to threefold. Never fails: no inliers is the sign of
/// a bad start.
PoseEstimate estimate_pose(const std::vector<Correspondence>& correspondences, const Pinhole& pinhole,
                           const Pose& camera_from_world_start);

/// The pose turned by exp(rotation) on the left and then moved.
Pose updated(const Pose& camera_from_world, Vec3 rotation_rad, Vec3 translation_m);

}  // namespace sediment::track
