#pragma once

#include "tools/synthesize/scene.hpp"

namespace sediment::synthetic {

/// Light that a surface at `point` with unit `normal` (world frame) sends back, as factor on its colour.
Rgb light_at(const Scene& scene, Vec3 point, Vec3 normal);

/// A hit of a ray, ready to be shown.
struct Shade {
  Rgb color;
  int face = 0;
  float u_m = 0, v_m = 0;
};

/// Colour of the place where the ray (x, y, 1) of the camera meets a solid at `depth_m`; `pixel_angle` is the
/// distance between neighbouring rays (1 / focal length).
Shade shade(const Scene& scene, const PlacedSolid& placed, const Pose& world_from_camera, double x, double y,
            double depth_m, double pixel_angle);

}  // namespace sediment::synthetic
