#pragma once

#include <array>
#include <vector>

#include "pipeline/scene/vec3.hpp"

namespace sediment {

/// A position in the image in pixels; pixel centres are at integer coordinates.
struct Pixel {
  double u = 0, v = 0;
};

/// Direction of a pixel's ray as (x/z, y/z) in the optical frame (z forward, x right, y down).
struct Ray {
  float x = 0, y = 0;
};

/// Pinhole camera with the Brown-Conrady lens model of OpenCV: k1 k2 p1 p2 k3. Images stay as the sensor gave
/// them; distortion is undone per point or per ray.
struct Camera {
  int width = 640, height = 480;          ///< pixels
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
  std::array<double, 5> distortion{};     ///< k1 k2 p1 p2 k3
  double depth_scale = 5000;              ///< depth image units per metre

  bool has_distortion() const;
  /// (x/z, y/z) of the ray through a pixel: the distortion is undone by fixed-point iteration, then Newton.
  Pixel undistort(Pixel pixel) const;
  /// Image of a point of the camera frame with z > 0, lens distortion included.
  Pixel project(Vec3 point) const;
  /// The same for a camera without distortion.
  Pixel project_straight(Vec3 point) const {
    return {fx * (point.x / point.z) + cx, fy * (point.y / point.z) + cy};
  }
  /// Equation (4) of the paper with the lens undone: the point seen at `pixel` with depth `z` (along the
  /// optical axis).
  Vec3 back_project(Pixel pixel, double depth_m) const {
    const Pixel ray = undistort(pixel);
    return {ray.u * depth_m, ray.v * depth_m, depth_m};
  }
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// The ray of every pixel, row by row (width * height entries): undoes the lens once per camera.
std::vector<Ray> rays_of(const Camera& camera);

}  // namespace sediment
