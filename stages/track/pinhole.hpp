#pragma once

#include "pipeline/scene/camera.hpp"
#include "stages/track/features.hpp"

namespace sediment::track {

/// The ideal camera that features live in after the lens is undone, the extent of its image, and the
/// standard deviations of what it measures.
struct Pinhole {
  double fx = 0, fy = 0, cx = 0, cy = 0;            ///< pixels
  double left = 0, right = 0, top = 0, bottom = 0;  ///< extent of the undistorted image, pixels
  double pixel_sigma_px = 1;                        ///< of a feature at octave 0
  double depth_sigma = 0.0014;                      ///< of an inverse depth, 1/m

  Pixel project(Vec3 point) const { return {fx * point.x / point.z + cx, fy * point.y / point.z + cy}; }
  bool sees(Pixel pixel) const {
    return pixel.u >= left && pixel.u < right && pixel.v >= top && pixel.v < bottom;
  }
  /// The point of the camera frame that a feature with depth measures.
  Vec3 point_of(const Feature& feature) const {
    const double depth_m = 1.0 / feature.inverse_depth;
    return {(feature.u_px - cx) / fx * depth_m, (feature.v_px - cy) / fy * depth_m, depth_m};
  }
};

Pinhole pinhole_of(const Camera& camera, const Parameters& parameters);

}  // namespace sediment::track
