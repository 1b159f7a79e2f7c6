#pragma once

#include <array>
#include <cstdint>

#include "tools/synthesize/solid.hpp"

namespace sediment::synthetic {

/// A solid prepared for rays that leave one camera: everything in the solid's frame, scaled so that boxes are
/// |x|,|y|,|z| <= 1 and flattened solids are round.
struct Target {
  Shape shape;
  float origin[3];  ///< the camera's centre
  float linear[9];  ///< row-major: direction in the solid's frame = linear * (x, y, 1)
  float size[3];    ///< as Solid::size
};
Target target_of(const Solid& solid, const Pose& camera_from_solid);

/// Rays of up to 256 pixels, cast together. Because a ray is (x, y, 1) in the camera frame, the distance
/// along it is the depth along the optical axis.
struct RayTile {
  static constexpr int kRays = 256;
  alignas(64) std::array<float, kRays> x, y;          ///< direction
  alignas(64) std::array<float, kRays> depth_m;       ///< nearest hit so far
  alignas(64) std::array<std::int32_t, kRays> solid;  ///< its solid, -1 = none
};

inline constexpr float kFar = 1e9f;

/// Keeps for each ray the nearer of its hit so far and its first hit with `target`.
void cast(const Target& target, std::int32_t solid_idx, RayTile& tile);

}  // namespace sediment::synthetic
