#include "stages/octree/frame_cells.hpp"

#include <octomap/octomap_types.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>

#include "pipeline/scene/frame.hpp"

namespace sediment::octree {
namespace {

constexpr double kMostCells = 8589934592.0;  // 2^33: a gigabyte of bits

int key_on(const Keys& keys, int axis) {
  return axis == 0 ? keys.x : axis == 1 ? keys.y : keys.z;
}

/// As OctoMap's keyToCoord.
double center_of(int key, double resolution_m) {
  return (static_cast<double>(key - (1 << (kTreeDepth - 1))) + 0.5) * resolution_m;
}

/// One bit for every cell of a box of whole bricks around the rays of a frame.
class RayBox {
 public:
  RayBox(const Keys& origin, std::span<const RayEnd> ends, double resolution_m) {
    // A ray may round past its end by one cell.
    for (int axis = 0; axis < 3; ++axis) {
      int low = key_on(origin, axis), high = low;
      for (const RayEnd& end : ends) {
        low = std::min(low, key_on(end.keys, axis));
        high = std::max(high, key_on(end.keys, axis));
      }
      low_[axis] = (low - 2) & ~7;
      size_[axis] = ((high + 2) | 7) + 1 - low_[axis];
    }
    const double cells = 1.0 * size_[0] * size_[1] * size_[2];
    if (cells > kMostCells)
      throw std::runtime_error("the rays span " + std::to_string(cells) + " cells of " +
                               std::to_string(resolution_m) + " m, more than 2^33: raise the resolution");
    bytes_ = static_cast<std::size_t>(cells) / 8;
  }

  std::size_t index_of(const Keys& keys) const {
    return (static_cast<std::size_t>(keys.z - low_[2]) * size_[1] + (keys.y - low_[1])) * size_[0] +
           (keys.x - low_[0]);
  }
  std::size_t bytes() const { return bytes_; }
  std::ptrdiff_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? size_[0] : static_cast<std::ptrdiff_t>(size_[0]) * size_[1];
  }

  /// The 8 x 8 x 8 bits at brick (x, y, z) of the box.
  std::array<std::uint64_t, 8> brick_of(const std::vector<std::uint8_t>& bits, int x, int y, int z) const {
    std::array<std::uint64_t, 8> brick{};
    const std::size_t row = size_[0] / 8, layer = row * size_[1];
    const std::uint8_t* first = bits.data() + z * 8 * layer + y * 8 * row + x;
    for (int layer_idx = 0; layer_idx < 8; ++layer_idx)
      for (int row_idx = 0; row_idx < 8; ++row_idx)
        brick[layer_idx] |= static_cast<std::uint64_t>(first[layer_idx * layer + row_idx * row])
                            << 8 * row_idx;
    return brick;
  }
  int bricks(int axis) const { return size_[axis] / 8; }
  std::uint64_t code_of_brick(int x, int y, int z) const {
    // Cells just outside the tree are in the box, but no ray reaches them: their codes are never used.
    return code_of(static_cast<std::uint16_t>(low_[0] / 8 + x), static_cast<std::uint16_t>(low_[1] / 8 + y),
                   static_cast<std::uint16_t>(low_[2] / 8 + z));
  }

 private:
  int low_[3] = {0, 0, 0}, size_[3] = {0, 0, 0};
  std::size_t bytes_ = 0;
};

bool test_and_set(std::vector<std::uint8_t>& bits, std::size_t idx) {
  const auto bit = static_cast<std::uint8_t>(1U << (idx & 7));
  const bool was = (bits[idx >> 3] & bit) != 0;
  bits[idx >> 3] |= bit;
  return was;
}

/// The value where the mask has ones, else zero.
double masked(double value, std::uint64_t mask) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & mask);
}

/// Casts rays from one origin. The arithmetic, types and order of operations are those of OctoMap's
/// computeRayKeys (Amanatides and Woo), so that every rounding is the same; the choice of the axis is made
/// without branches, which no processor can predict here.
class RayCaster {
 public:
  RayCaster(const octomap::point3d& origin, const Keys& origin_keys, const RayBox& box, double resolution_m)
      : origin_(origin), origin_keys_(origin_keys), box_(box), resolution_m_(resolution_m) {
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        double border = center_of(key_on(origin_keys, axis), resolution_m);
        border += static_cast<float>(step * resolution_m * 0.5);
        to_border_[axis][step > 0] = border - origin(axis);
      }
  }

  void cast(const Keys& end_keys, std::vector<std::uint8_t>& free) const {
    const std::size_t end_idx = box_.index_of(end_keys);
    std::size_t idx = box_.index_of(origin_keys_);
    if (idx == end_idx) return;
    test_and_set(free, idx);
    octomap::point3d direction(static_cast<float>(center_of(end_keys.x, resolution_m_)),
                               static_cast<float>(center_of(end_keys.y, resolution_m_)),
                               static_cast<float>(center_of(end_keys.z, resolution_m_)));
    direction = direction - origin_;
    const float length = static_cast<float>(direction.norm());
    direction /= length;
    double next[3], delta[3];
    std::uint64_t step[3];
    for (int axis = 0; axis < 3; ++axis) {
      const float along = direction(axis);
      const bool moves = along > 0.0F || along < 0.0F;
      next[axis] = moves ? to_border_[axis][along > 0.0F] / along : std::numeric_limits<double>::max();
      delta[axis] = moves ? resolution_m_ / std::fabs(along) : std::numeric_limits<double>::max();
      step[axis] = static_cast<std::uint64_t>(along > 0.0F ? box_.stride(axis) : -box_.stride(axis));
    }
    walk(idx, end_idx, length, next, delta, step, free.data());
  }

 private:
  static void walk(std::size_t idx, std::size_t end_idx, double length, const double* next,
                   const double* delta, const std::uint64_t* step, std::uint8_t* free) {
    double x = next[0], y = next[1], z = next[2];
    while (true) {
      const bool x_before_y = x < y, x_before_z = x < z, y_before_z = y < z;
      const std::uint64_t in_x = -static_cast<std::uint64_t>(x_before_y & x_before_z);
      const std::uint64_t in_y = -static_cast<std::uint64_t>(!x_before_y & y_before_z);
      const std::uint64_t in_z = ~(in_x | in_y);
      idx += (step[0] & in_x) | (step[1] & in_y) | (step[2] & in_z);
      x += masked(delta[0], in_x);
      y += masked(delta[1], in_y);
      z += masked(delta[2], in_z);
      // The second: rounding led past the end.
      if (idx == end_idx || std::min(std::min(x, y), z) > length) return;
      free[idx >> 3] = static_cast<std::uint8_t>(free[idx >> 3] | 1U << (idx & 7));
    }
  }

  octomap::point3d origin_;
  Keys origin_keys_;
  const RayBox& box_;
  double resolution_m_;
  double to_border_[3][2];
};

}  // namespace

std::vector<Brick> cells_of_rays(Vec3 origin, std::span<const RayEnd> ends, double resolution_m) {
  const octomap::point3d from(static_cast<float>(origin.x), static_cast<float>(origin.y),
                              static_cast<float>(origin.z));
  const Keys origin_keys{key_of(from.x(), resolution_m), key_of(from.y(), resolution_m),
                         key_of(from.z(), resolution_m)};
  const RayBox box(origin_keys, ends, resolution_m);
  std::vector<std::uint8_t> free(box.bytes()), occupied(box.bytes()), asked(box.bytes());
  const RayCaster caster(from, origin_keys, box, resolution_m);
  for (const RayEnd& end : ends) {
    const std::size_t idx = box.index_of(end.keys);
    if (end.fills) test_and_set(occupied, idx);
    if (!test_and_set(asked, idx)) caster.cast(end.keys, free);
  }
  std::vector<Brick> bricks;
  for (int z = 0; z < box.bricks(2); ++z)
    for (int y = 0; y < box.bricks(1); ++y)
      for (int x = 0; x < box.bricks(0); ++x) {
        Brick brick{0, box.brick_of(free, x, y, z), box.brick_of(occupied, x, y, z)};
        std::uint64_t any = 0;
        for (int word = 0; word < 8; ++word) {
          brick.free[word] &= ~brick.occupied[word];
          any |= brick.free[word] | brick.occupied[word];
        }
        if (any == 0) continue;
        brick.code = box.code_of_brick(x, y, z);
        bricks.push_back(brick);
      }
  std::sort(bricks.begin(), bricks.end(), [](const Brick& a, const Brick& b) { return a.code < b.code; });
  return bricks;
}

std::vector<RayEnd> ray_ends(const DepthView& view, const Camera& camera, std::span<const Ray> rays,
                             const RayParameters& parameters, double resolution_m) {
  std::vector<RayEnd> ends;
  for (int v = 0; v < camera.height; v += parameters.pixel_step) {
    const auto* depth = view.depth.ptr<std::uint16_t>(v);
    const auto* dynamic = view.dynamic.empty() ? nullptr : view.dynamic.ptr<std::uint8_t>(v);
    const Ray* ray = rays.data() + static_cast<std::size_t>(v) * camera.width;
    for (int u = 0; u < camera.width; u += parameters.pixel_step) {
      const double measured_m = depth[u] / camera.depth_scale;
      if (depth[u] == 0 || measured_m < parameters.min_depth_m) continue;
      const double z = std::min(measured_m, parameters.max_depth_m);
      const Vec3 p = view.world_from_camera * Vec3{ray[u].x * z, ray[u].y * z, z};
      const bool is_static = dynamic == nullptr || dynamic[u] == kStatic;
      ends.push_back(
          {{key_of(static_cast<float>(p.x), resolution_m), key_of(static_cast<float>(p.y), resolution_m),
            key_of(static_cast<float>(p.z), resolution_m)},
           is_static && measured_m <= parameters.max_depth_m});
    }
  }
  return ends;
}

}  // namespace sediment::octree
