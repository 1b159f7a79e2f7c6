#pragma once

#include "tools/synthesize/ray_tile.hpp"
#include "tools/synthesize/texture.hpp"

namespace sediment::synthetic {

/// A flat face as the camera sees it, in the camera frame: a point p on it has u = dot(p, u_axis) + u_shift.
struct FaceView {
  std::array<float, 3> normal, u_axis, v_axis;
  float u_shift = 0, v_shift = 0;
};
FaceView face_view(const Solid& solid, int face, const Pose& camera_from_solid);

/// Some of a tile's rays, with where each hits.
struct Hits {
  using Values = std::array<float, RayTile::kRays>;
  alignas(64) Values x, y, depth_m;
  std::array<std::uint8_t, RayTile::kRays> ray;  ///< index in the tile
  int count = 0;

  void add(const RayTile& tile, int i) {
    add(tile.x[i], tile.y[i], tile.depth_m[i], static_cast<std::uint8_t>(i));
  }
  void add(const Hits& hits, int i) { add(hits.x[i], hits.y[i], hits.depth_m[i], hits.ray[i]); }

 private:
  void add(float ray_x, float ray_y, float ray_depth_m, std::uint8_t ray_idx) {
    x[count] = ray_x, y[count] = ray_y, depth_m[count] = ray_depth_m, ray[count++] = ray_idx;
  }
};

/// The face of a box that each ray hits.
void faces_of(const Target& box, const Hits& hits, std::array<std::int32_t, RayTile::kRays>& faces);

/// Where rays hit a flat face, and how far a pixel reaches there. `pixel_angle` is the distance between
/// neighbouring rays.
void places_of(const FaceView& face, const Hits& hits, float pixel_angle, Places& places);
/// The same where one ray hits a curved surface whose tangent plane is `tangent`.
Footprint footprint_of(const FaceView& tangent, float x, float y, float depth_m, float pixel_angle);

}  // namespace sediment::synthetic
