#include "stages/voxel/voxel_keys.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sediment::voxel {
namespace {

/// Larger ones do not fit 64 bits.
constexpr float kLargestIndex = 0x1p61f;
constexpr int kTooMany = 64;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Bounds {
  std::array<float, 3> min{kInfinity, kInfinity, kInfinity}, max{-kInfinity, -kInfinity, -kInfinity};

  void add(const std::array<float, 3>& low, const std::array<float, 3>& high) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], low[axis]);
      max[axis] = std::max(max[axis], high[axis]);
    }
  }
};

Bounds bounds_of(const LabelledCloud& cloud) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, cloud.size(), 1 << 15), Bounds{},
      [&](const Range& range, Bounds bounds) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          if (const LabelledPoint& p = cloud[i]; not_finite(p) == 0)
            bounds.add({p.x, p.y, p.z}, {p.x, p.y, p.z});
        return bounds;
      },
      [](Bounds a, const Bounds& b) {
        a.add(b.min, b.max);
        return a;
      });
}

}  // namespace

VoxelKeys::VoxelKeys(const LabelledCloud& cloud, float leaf_m) : voxels_per_metre_(1.0f / leaf_m) {
  const Bounds bounds = bounds_of(cloud);
  std::array<int, 3> bits{};
  for (std::size_t axis = 0; axis < 3 && bounds.min[axis] <= bounds.max[axis]; ++axis) {
    const float first = std::floor(bounds.min[axis] * voxels_per_metre_),
                last = std::floor(bounds.max[axis] * voxels_per_metre_);
    bits[axis] = kTooMany;
    if (first < -kLargestIndex || last > kLargestIndex) continue;
    first_[axis] = static_cast<std::int64_t>(first);
    bits[axis] = std::bit_width(static_cast<std::uint64_t>(static_cast<std::int64_t>(last) - first_[axis]));
  }
  if (const int sum = bits[0] + bits[1] + bits[2]; sum > 63)
    throw std::runtime_error("the cloud is too large for its leaf size: the number of a voxel would need " +
                             std::to_string(sum) +
                             " bits, 63 are there; raise `leaf` or remove far outliers first");
  shifts_ = {0, bits[0], bits[0] + bits[1]};
  bits_z_ = bits[2];
}

}  // namespace sediment::voxel
