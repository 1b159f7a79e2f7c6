#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "stages/voxel/voxel_keys.hpp"

namespace sediment::voxel {

/// A point with its voxel.
struct KeyedPoint {
  std::uint64_t key;
  LabelledPoint point;
};

/// The finite points of a cloud, parted into buckets that fit a processor's cache: every key of a bucket is
/// below every key of the next one. Within a bucket the points are in the order of the cloud.
struct Buckets {
  std::unique_ptr<KeyedPoint[]> points;
  std::vector<std::size_t> begin;  ///< bucket i is [begin[i], begin[i + 1])

  std::size_t size() const { return begin.back(); }
  std::size_t count() const { return begin.size() - 1; }
  std::span<KeyedPoint> bucket(std::size_t i) { return {&points[begin[i]], begin[i + 1] - begin[i]}; }
};

/// One pass that counts the leading digits of the keys, and one that moves the points. In parallel, the same
/// at any thread count.
Buckets part_into_buckets(const LabelledCloud& cloud, const VoxelKeys& keys);

}  // namespace sediment::voxel
