#pragma once

#include <array>
#include <span>
#include <vector>

#include "pipeline/scene/pose.hpp"
#include "stages/track/residual.hpp"

namespace sediment::track {

/// A landmark and what the frame measured of it.
struct Correspondence {
  Vec3 point;  ///< world frame
  Measurement measurement;
};

/// How the frame lies to another camera whose pose is known, by the alignment of their whole images.
struct AlignedView {
  Pose camera_from_world;  ///< of the other camera
  Pose frame_from_camera;
  std::array<double, 36> information{};  ///< of its error: rotation on the left, then translation
};

struct PoseEstimate {
  Pose camera_from_world;
  std::vector<char> inlier;  ///< per correspondence
  int inliers = 0;
  double residual_px = 0;  ///< root mean square reprojection error of the inliers
  double noise_scale = 1;  ///< noise of the frame as a multiple of what the measurements promise, 1 .. 3
  double deviation_rad = 0, deviation_m = 0;  ///< of the rotation, of the camera's centre; 0 = not known
};

/// The pose that fits the correspondences best from a start nearby: Gauss-Newton with Huber weights over the
/// three-row residual, four rounds between which correspondences beyond the chi-square bound are set aside
/// and may come back (ORB-SLAM2's scheme). Blur and fast motion make a whole frame noisier than its
/// neighbours: the median residual scales the bounds, up to threefold. Never fails: no inliers is the sign of
/// a bad start. `views` count beside the correspondences, each under a Huber loss of its own.
PoseEstimate estimate_pose(const std::vector<Correspondence>& correspondences, const Pinhole& pinhole,
                           const Pose& camera_from_world_start, std::span<const AlignedView> views = {});

/// The pose turned by exp(rotation) on the left and then moved.
Pose updated(const Pose& camera_from_world, Vec3 rotation_rad, Vec3 translation_m);

}  // namespace sediment::track
