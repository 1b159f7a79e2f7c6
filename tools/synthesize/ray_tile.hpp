#pragma once

#include <algorithm>
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

inline constexpr float kFar = 1e9f;

/// Box of ray directions (x, y).
struct RayBounds {
  float x_low = kFar, x_high = -kFar, y_low = kFar, y_high = -kFar;

  void include(float x, float y) {
    x_low = std::min(x_low, x), x_high = std::max(x_high, x);
    y_low = std::min(y_low, y), y_high = std::max(y_high, y);
  }
  bool meets(const RayBounds& other) const {
    return x_low <= other.x_high && x_high >= other.x_low && y_low <= other.y_high && y_high >= other.y_low;
  }
};
/// Where rays must point to hit a solid, and how near it may be along them; everywhere if it reaches behind
/// the camera, nowhere if it is behind it.
struct Reach {
  RayBounds rays;
  float nearest_m = 0;
};
Reach reach_of(const Solid& solid, const Pose& camera_from_solid);

/// Rays of up to 256 pixels, cast together. Because a ray is (x, y, 1) in the camera frame, the distance
/// along it is the depth along the optical axis.
struct RayTile {
  static constexpr int kRays = 256, kBlock = 16, kBlocks = kRays / kBlock;
  alignas(64) std::array<float, kRays> x, y;          ///< direction
  alignas(64) std::array<float, kRays> depth_m;       ///< nearest hit so far
  alignas(64) std::array<std::int32_t, kRays> solid;  ///< its solid, -1 = none

  /// To be called when the directions are there: nothing is hit yet. Rays from `count` on are not cast, but
  /// for those that fill up the last 16.
  void start(int count = kRays);
  /// The same; what is not nearer than `depth_m` is no hit.
  void start_before_depth(int count = kRays);
  /// No hit, or none yet, is beyond.
  float farthest_m() const { return *std::max_element(block_depth_m.begin(), block_depth_m.end()); }

  // Of every 16 rays, which are near each other: bounds a little too wide, and the farthest hit.
  std::array<RayBounds, kBlocks> block_rays;
  std::array<float, kBlocks> block_depth_m;
};

/// Keeps for each ray the nearer of its hit so far and its first hit with `target`. Rays that `reach` leaves
/// out are passed over.
void cast(const Target& target, const Reach& reach, std::int32_t solid_idx, RayTile& tile);

}  // namespace sediment::synthetic
