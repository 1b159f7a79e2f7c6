#include "stages/voxel/voxel_keys.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "pipeline/sorting/radix_sort.hpp"

namespace sediment::voxel {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t kGrain = 1 << 14;

/// Voxel indices along x, y, z. Whole numbers in float: a float has no finer ones out there.
using Cell = std::array<float, 3>;

Cell cell_of(const LabelledPoint& p, float voxels_per_metre) {
  return {std::floor(p.x * voxels_per_metre), std::floor(p.y * voxels_per_metre),
          std::floor(p.z * voxels_per_metre)};
}

struct CellBounds {
  Cell min{INFINITY, INFINITY, INFINITY}, max{-INFINITY, -INFINITY, -INFINITY};

  void add(const Cell& low, const Cell& high) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], low[axis]);
      max[axis] = std::max(max[axis], high[axis]);
    }
  }
};

bool is_finite(const LabelledPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

std::vector<std::uint32_t> finite_points(const LabelledCloud& cloud) {
  std::vector<std::uint32_t> indices(cloud.size());
  std::iota(indices.begin(), indices.end(), 0u);
  std::erase_if(indices, [&](std::uint32_t idx) { return !is_finite(cloud[idx]); });
  return indices;
}

CellBounds bounds_of(const LabelledCloud& cloud, const std::vector<std::uint32_t>& indices,
                     float voxels_per_metre) {
  return tbb::parallel_reduce(
      Range(0, indices.size(), kGrain), CellBounds{},
      [&](const Range& range, CellBounds bounds) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const Cell cell = cell_of(cloud[indices[i]], voxels_per_metre);
          bounds.add(cell, cell);
        }
        return bounds;
      },
      [](CellBounds a, const CellBounds& b) {
        a.add(b.min, b.max);
        return a;
      });
}

}  // namespace

KeyedPoints sort_into_voxels(const LabelledCloud& cloud, float leaf_m) {
  const float voxels_per_metre = 1.0f / leaf_m;
  KeyedPoints points;
  points.point_idx = finite_points(cloud);
  if (points.point_idx.empty()) return points;

  const CellBounds bounds = bounds_of(cloud, points.point_idx, voxels_per_metre);
  std::array<int, 3> bits{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(bounds.max[axis]) - bounds.min[axis];
    if (!(last < 0x1p62))
      throw std::runtime_error(
          "the cloud is too large for its leaf size: more than 2^62 voxels along an axis");
    bits[axis] = std::bit_width(static_cast<std::uint64_t>(last));
  }
  const int key_bits = bits[0] + bits[1] + bits[2];
  if (key_bits > 64)
    throw std::runtime_error("the cloud is too large for its leaf size: a voxel's key would need " +
                             std::to_string(key_bits) +
                             " bits, 64 are there; raise `leaf` or remove far outliers first");

  points.keys.resize(points.point_idx.size());
  tbb::parallel_for(Range(0, points.keys.size(), kGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Cell cell = cell_of(cloud[points.point_idx[i]], voxels_per_metre);
      const auto index = [&](std::size_t axis) {
        return static_cast<std::uint64_t>(static_cast<double>(cell[axis]) - bounds.min[axis]);
      };
      std::uint64_t key = 0;
      if (bits[2] > 0) key = index(2);
      if (bits[1] > 0) key = key << bits[1] | index(1);
      if (bits[0] > 0) key = key << bits[0] | index(0);
      points.keys[i] = key;
    }
  });
  sort_by_key(points.keys, points.point_idx, key_bits);
  return points;
}

}  // namespace sediment::voxel
