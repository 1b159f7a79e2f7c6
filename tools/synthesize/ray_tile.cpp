#include "tools/synthesize/ray_tile.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synthesize/vector_code.hpp"

namespace sediment::synthetic {
namespace {

constexpr float kNear = 1e-3f;

// A direction parallel to a face must not divide by zero.
SEDIMENT_INLINE float reciprocal(float d) {
  return 1.f / (std::fabs(d) < 1e-12f ? 1e-12f : d);
}
SEDIMENT_INLINE float accept(bool valid, float t) {
  return valid & (t > kNear) ? t : kFar;
}
SEDIMENT_INLINE void keep(RayTile& tile, int i, float t, std::int32_t solid_idx) {
  const bool nearer = t < tile.depth_m[i];
  tile.depth_m[i] = nearer ? t : tile.depth_m[i];
  tile.solid[i] = nearer ? solid_idx : tile.solid[i];
}

/// Indices of blocks of rays.
struct Blocks {
  std::array<std::uint8_t, RayTile::kBlocks> idx;
  int count = 0;
};

template <class Work>
SEDIMENT_INLINE void for_each_ray(const Blocks& blocks, RayTile& tile, const Work& work) {
  for (int k = 0; k < blocks.count; ++k) {
    const int block = blocks.idx[static_cast<std::size_t>(k)], first = block * RayTile::kBlock;
    for (int i = first; i < first + RayTile::kBlock; ++i) work(i);
    float farthest = 0;
    for (int i = first; i < first + RayTile::kBlock; ++i) farthest = greater(farthest, tile.depth_m[i]);
    tile.block_depth_m[static_cast<std::size_t>(block)] = farthest;
  }
}

struct Direction {
  float x, y, z;
};
SEDIMENT_INLINE Direction direction_of(const Target& s, float x, float y) {
  return {s.linear[0] * x + s.linear[1] * y + s.linear[2], s.linear[3] * x + s.linear[4] * y + s.linear[5],
          s.linear[6] * x + s.linear[7] * y + s.linear[8]};
}

SEDIMENT_CLONES void cast_box(const Target& target, std::int32_t solid_idx, const Blocks& blocks,
                              RayTile& tile) {
  const Target s = target;  // a copy: what is written to the tile cannot change it
  for_each_ray(blocks, tile, [&](int i) {
    const Direction d = direction_of(s, tile.x[i], tile.y[i]);
    const float ix = reciprocal(d.x), iy = reciprocal(d.y), iz = reciprocal(d.z);
    const float x0 = (-1 - s.origin[0]) * ix, x1 = (1 - s.origin[0]) * ix;
    const float y0 = (-1 - s.origin[1]) * iy, y1 = (1 - s.origin[1]) * iy;
    const float z0 = (-1 - s.origin[2]) * iz, z1 = (1 - s.origin[2]) * iz;
    const float enter = greater(greater(lesser(x0, x1), lesser(y0, y1)), lesser(z0, z1));
    const float leave = lesser(lesser(greater(x0, x1), greater(y0, y1)), greater(z0, z1));
    keep(tile, i, accept(enter <= leave, enter), solid_idx);
  });
}

// Entry into a ball around (0, 0, centre_z).
SEDIMENT_INLINE float enter_ball(const Target& s, const Direction& d, float centre_z, float radius) {
  const float oz = s.origin[2] - centre_z;
  const float a = d.x * d.x + d.y * d.y + d.z * d.z;
  const float b = s.origin[0] * d.x + s.origin[1] * d.y + oz * d.z;
  const float c = s.origin[0] * s.origin[0] + s.origin[1] * s.origin[1] + oz * oz - radius * radius;
  const float discriminant = b * b - a * c;
  return accept(discriminant >= 0, (-b - std::sqrt(greater(discriminant, 0))) / a);
}

// The hull of two balls is convex, so its entry is the first of the entries into the balls and the hits of
// the cone that touches both: rho * cosine + z * slope = r0 for z in [r0 * slope, length + r1 * slope].
SEDIMENT_CLONES void cast_capsule(const Target& target, std::int32_t solid_idx, const Blocks& blocks,
                                  RayTile& tile) {
  const Target s = target;  // a copy: what is written to the tile cannot change it
  const float r0 = s.size[0], r1 = s.size[1], length = s.size[2];
  const float slope = (r0 - r1) / length, cosine2 = 1 - slope * slope;
  const float low = r0 * slope, high = length + r1 * slope;
  const float rest = r0 - slope * s.origin[2];
  const float c = s.origin[0] * s.origin[0] + s.origin[1] * s.origin[1] - rest * rest / cosine2;
  for_each_ray(blocks, tile, [&](int i) {
    const Direction d = direction_of(s, tile.x[i], tile.y[i]);
    const float a = d.x * d.x + d.y * d.y - slope * slope * d.z * d.z / cosine2;
    const float b = s.origin[0] * d.x + s.origin[1] * d.y + rest * slope * d.z / cosine2;
    const float discriminant = b * b - a * c, root = std::sqrt(greater(discriminant, 0));
    const float ia = reciprocal(a);
    const float t0 = (-b - root) * ia, t1 = (-b + root) * ia;
    const float z0 = s.origin[2] + t0 * d.z, z1 = s.origin[2] + t1 * d.z;
    const float cone = lesser(accept((discriminant >= 0) & (z0 >= low) & (z0 <= high), t0),
                              accept((discriminant >= 0) & (z1 >= low) & (z1 <= high), t1));
    keep(tile, i, lesser(cone, lesser(enter_ball(s, d, 0, r0), enter_ball(s, d, length, r1))), solid_idx);
  });
}

SEDIMENT_CLONES void cast_cylinder(const Target& target, std::int32_t solid_idx, const Blocks& blocks,
                                   RayTile& tile) {
  const Target s = target;  // a copy: what is written to the tile cannot change it
  const float radius = s.size[0], length = s.size[2];
  const float c = s.origin[0] * s.origin[0] + s.origin[1] * s.origin[1] - radius * radius;
  for_each_ray(blocks, tile, [&](int i) {
    const Direction d = direction_of(s, tile.x[i], tile.y[i]);
    const float a = greater(d.x * d.x + d.y * d.y, 1e-12f);
    const float b = s.origin[0] * d.x + s.origin[1] * d.y;
    const float discriminant = b * b - a * c, root = std::sqrt(greater(discriminant, 0));
    // Between the side's two planes of entry and exit and between the two caps.
    const float iz = reciprocal(d.z);
    const float cap0 = -s.origin[2] * iz, cap1 = (length - s.origin[2]) * iz;
    const float enter = greater((-b - root) / a, lesser(cap0, cap1));
    const float leave = lesser((-b + root) / a, greater(cap0, cap1));
    keep(tile, i, accept((discriminant >= 0) & (enter <= leave), enter), solid_idx);
  });
}

}  // namespace

Target target_of(const Solid& solid, const Pose& camera_from_solid) {
  const Pose solid_from_camera = camera_from_solid.inverse();
  Target target{solid.shape, {}, {}, {}};
  const double size[3] = {solid.size.x, solid.size.y, solid.size.z};
  const double origin[3] = {solid_from_camera.translation.x, solid_from_camera.translation.y,
                            solid_from_camera.translation.z};
  for (int row = 0; row < 3; ++row) {
    const double scale = solid.shape == Shape::box ? 1 / size[row] : row == 1 ? 1 / solid.flatten : 1;
    target.size[row] = static_cast<float>(size[row]);
    target.origin[row] = static_cast<float>(scale * origin[row]);
    for (int col = 0; col < 3; ++col)
      target.linear[3 * row + col] = static_cast<float>(scale * solid_from_camera.rotation[3 * row + col]);
  }
  return target;
}

void RayTile::start(int count) {
  depth_m.fill(kFar);
  start_before_depth(count);
}

void RayTile::start_before_depth(int count) {
  constexpr float kRounding = 1e-5f;  // hundredths of a pixel
  solid.fill(-1);
  block_depth_m.fill(-1);  // before everything
  block_rays.fill({});
  for (int block = 0; block * kBlock < count; ++block) {
    RayBounds bounds;
    float farthest = 0;
    for (int i = block * kBlock; i < (block + 1) * kBlock; ++i) {
      bounds.include(x[i], y[i]);
      farthest = greater(farthest, depth_m[i]);
    }
    block_rays[block] = {bounds.x_low - kRounding, bounds.x_high + kRounding, bounds.y_low - kRounding,
                         bounds.y_high + kRounding};
    block_depth_m[block] = farthest;
  }
}

void cast(const Target& target, const Reach& reach, std::int32_t solid_idx, RayTile& tile) {
  const float nearest_m = 0.9999f * reach.nearest_m - 1e-4f;  // rounding
  Blocks blocks;
  for (int block = 0; block < RayTile::kBlocks; ++block)
    if (nearest_m <= tile.block_depth_m[block] && tile.block_rays[block].meets(reach.rays))
      blocks.idx[blocks.count++] = static_cast<std::uint8_t>(block);
  if (blocks.count == 0) return;
  switch (target.shape) {
    case Shape::box:
      return cast_box(target, solid_idx, blocks, tile);
    case Shape::capsule:
      return cast_capsule(target, solid_idx, blocks, tile);
    case Shape::cylinder:
      return cast_cylinder(target, solid_idx, blocks, tile);
  }
}

namespace {

// A ball's directions, by its distance at both ends: a little larger than the ellipse it projects to.
void include_ball(Reach& reach, Vec3 centre, double radius) {
  for (const double z : {centre.z - radius, centre.z + radius})
    for (const double side : {-radius, radius})
      reach.rays.include(static_cast<float>((centre.x + side) / z),
                         static_cast<float>((centre.y + side) / z));
  reach.nearest_m = std::min(reach.nearest_m, static_cast<float>(centre.z - radius));
}

}  // namespace

Reach reach_of(const Solid& solid, const Pose& camera_from_solid) {
  constexpr double kClose = 0.02;
  const Vec3& s = solid.size;
  Reach reach{{}, kFar};
  double farthest = -kFar;
  if (solid.shape == Shape::box) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p =
          camera_from_solid * Vec3{corner & 1 ? s.x : -s.x, corner & 2 ? s.y : -s.y, corner & 4 ? s.z : -s.z};
      reach.nearest_m = std::min(reach.nearest_m, static_cast<float>(p.z));
      farthest = std::max(farthest, p.z);
      if (p.z > kClose) reach.rays.include(static_cast<float>(p.x / p.z), static_cast<float>(p.y / p.z));
    }
  } else {
    // A capsule is the hull of two balls; a cylinder is inside one ball around its middle.
    const double wide = std::max(1.0, solid.flatten);
    const bool capsule = solid.shape == Shape::capsule;
    const double radius[2] = {wide * (capsule ? s.x : std::hypot(s.x, s.z / 2)),
                              wide * (capsule ? s.y : std::hypot(s.x, s.z / 2))};
    for (int end = 0; end < 2; ++end) {
      const Vec3 centre = camera_from_solid * Vec3{0, 0, capsule ? end * s.z : s.z / 2};
      farthest = std::max(farthest, centre.z + radius[end]);
      if (centre.z - radius[end] > kClose)
        include_ball(reach, centre, radius[end]);
      else
        reach.nearest_m = -kFar;
    }
  }
  if (farthest < kClose) return {{}, kFar};
  if (reach.nearest_m < kClose) return {{-kFar, kFar, -kFar, kFar}, 0};
  return reach;
}

}  // namespace sediment::synthetic
