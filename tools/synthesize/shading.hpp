#pragma once

#include "tools/synthesize/lighting.hpp"

namespace sediment::synthetic {

/// What a picture shows.
struct View {
  const Scene& scene;
  const Lighting& lighting;
  const Moment& moment;
  Pose world_from_camera;
  std::vector<Pose> camera_from_solid;  ///< by solid of the moment
  double pixel_angle;                   ///< distance between neighbouring rays: 1 / focal length in pixels
};

/// A hit of a ray, ready to be shown.
struct Shade {
  Rgb color;
  int face = 0;
  float u_m = 0, v_m = 0;
};

/// Colour of the place where the ray (x, y, 1) of the camera meets a solid (index into moment.solids) at
/// `depth_m`.
Shade shade(const View& view, int solid_idx, double x, double y, double depth_m);

}  // namespace sediment::synthetic
