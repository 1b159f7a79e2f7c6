#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "stages/voxel/voxel_keys.hpp"

namespace sediment::voxel {

/// Room for points, not initialised. In huge pages where the system has them: asking for memory page by
/// page takes time that shows.
class PointBuffer {
 public:
  PointBuffer() = default;
  /// Throws std::bad_alloc.
  explicit PointBuffer(std::size_t points);
  LabelledPoint* data() const { return points_.get(); }

 private:
  struct Free {
    void operator()(LabelledPoint* points) const { std::free(points); }
  };
  std::unique_ptr<LabelledPoint[], Free> points_;
};

/// The finite points of a cloud, parted into buckets that fit a processor's cache: every key of a bucket is
/// below every key of the next one. Within a bucket the points are in the order of the cloud.
struct Buckets {
  PointBuffer points;
  std::vector<std::size_t> begin;  ///< bucket i is [begin[i], begin[i + 1])

  std::size_t size() const { return begin.back(); }
  std::size_t count() const { return begin.size() - 1; }
  std::span<LabelledPoint> bucket(std::size_t i) {
    return {points.data() + begin[i], begin[i + 1] - begin[i]};
  }
};

/// One pass that counts the leading digits of the keys, and one that moves the points. In parallel, the same
/// at any thread count.
Buckets part_into_buckets(const LabelledCloud& cloud, const VoxelKeys& keys);

}  // namespace sediment::voxel
