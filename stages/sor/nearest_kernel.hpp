#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sediment::sor {

/// Three arrays of coordinates, `size` of each. Arrays must be readable up to the next multiple of 16, with
/// points infinitely far away behind the last one.
struct Coordinates {
  float *x, *y, *z;
  std::size_t size;
};

/// Boxes as six arrays.
struct BoxArrays {
  const float *min[3], *max[3];
};

/// The k smallest of some squared distances.
struct Nearest {
  double distance_sum;     ///< of their square roots, in double
  float squared_distance;  ///< at least the largest of them; what was not chosen is not smaller than the
                           ///< largest
};

/// The inner loops, compiled for one set of instructions. All kernels give the same bits: squared distances
/// are formed in float, x then y then z, never fused; sums run over eight lanes whatever the width of the
/// vectors.
struct NearestKernel {
  const char* name;

  /// The `k` of the points nearest to (x, y, z), at least k of which must be within `squared_limit`.
  /// `scratch` has room for size + 16 floats.
  Nearest (*nearest)(const Coordinates& points, float x, float y, float z, std::size_t k, float squared_limit,
                     float* scratch);

  /// A squared distance within which at least `k` of the points lie, and at most an eighth more unless equal.
  /// At least k points are needed.
  float (*nearest_limit)(const Coordinates& points, float x, float y, float z, std::size_t k, float* scratch);

  /// Moves the points within `squared_limit` of (x, y, z) to the front, in their order; returns how many they
  /// are.
  std::size_t (*keep_near)(const Coordinates& points, float x, float y, float z, float squared_limit);

  /// Which of the eight boxes from `first` on are within `squared_limit` of a box (min x y z, max x y z): a
  /// bit for each. Leaves their squared distances, 0 where they meet, in `squared`.
  std::uint32_t (*boxes_near)(const BoxArrays& boxes, std::size_t first, const float* box,
                              float squared_limit, float* squared);
};

/// Those this processor can run, the plain one first and the fastest last.
std::span<const NearestKernel* const> available_kernels();

}  // namespace sediment::sor
