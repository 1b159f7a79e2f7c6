#pragma once

#include <optional>
#include <span>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/pose.hpp"

namespace sediment {

/// A point of one frame and the direction in which the next frame sees it.
struct SeenPoint {
  Vec3 point_m;  ///< camera frame of the one
  Pixel ray;     ///< (x/z, y/z) in the other: the lens undone
};

/// Motion of the camera between two frames, from what stands still.
struct CameraMotion {
  Pose to_from;                ///< transforms points of the one frame into the camera frame of the other
  double median_error_px = 0;  ///< distance between where points are seen and where they should be
  double inlier_share = 0;     ///< of the points, those that agree with it
};

/// Fits the rigid motion of most of the points: Gauss-Newton on the image distance with Tukey's weights,
/// which give points that move on their own no say; the scale of the weights is the median distance.
/// `focal_px` turns directions into pixels. None if fewer than 30 points, or less than a third of them,
/// agree.
std::optional<CameraMotion> camera_motion(std::span<const SeenPoint> points, double focal_px);

}  // namespace sediment
