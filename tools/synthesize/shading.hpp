#pragma once

#include <span>

#include "tools/synthesize/lighting.hpp"
#include "tools/synthesize/ray_tile.hpp"

namespace sediment::synthetic {

/// A flat face as the camera sees it, in the camera frame: a point p on it has u = dot(p, u_axis) + u_shift.
struct FaceView {
  std::array<float, 3> normal, u_axis, v_axis;
  float u_shift = 0, v_shift = 0;
};

/// A solid as the camera sees it at one time.
struct SolidView {
  const PlacedSolid* placed;
  Pose camera_from_solid;
  Target target;
  Reach reach;
  std::array<FaceView, kFaces> faces;  ///< of a box
  LightCube air;                       ///< light around a solid that may move
};

/// What a picture shows.
struct View {
  const Scene& scene;
  const Lighting& lighting;
  const Moment& moment;
  Pose world_from_camera;
  float pixel_angle;  ///< distance between neighbouring rays: 1 / focal length in pixels
  std::vector<SolidView> solids;
};
View view_of(const Scene& scene, const Lighting& lighting, const Moment& moment,
             const Pose& world_from_camera, double pixel_angle);

/// A hit of a ray, ready to be shown.
struct Shade {
  Rgb color;
  int face = 0;
  float u_m = 0, v_m = 0;
};

/// Colour of the place where the ray (x, y, 1) of the camera meets a solid (index into moment.solids) at
/// `depth_m`.
Shade shade(const View& view, int solid_idx, float x, float y, float depth_m);

}  // namespace sediment::synthetic
