#pragma once

#include <span>

#include "tools/synthesize/lighting.hpp"
#include "tools/synthesize/ray_tile.hpp"
#include "tools/synthesize/surface_hits.hpp"

namespace sediment::synthetic {

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

/// What the rays of a tile show, where they hit something.
struct Shades {
  Colors color;
  std::array<std::uint8_t, RayTile::kRays> face;
  std::array<float, RayTile::kRays> u_m, v_m;
};
/// Colour and place of the hits of the tile's first `count` rays.
void shade(const View& view, const RayTile& tile, int count, Shades& shades);

}  // namespace sediment::synthetic
