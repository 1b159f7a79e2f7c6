#pragma once

#include <array>
#include <cstdint>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::voxel {

/// Numbers the voxels of a cloud: z counts most, then y, then x, as in PCL's order. A voxel holds [i * leaf,
/// (i + 1) * leaf) along each axis, from the origin of the world on; the index is floor(x * (1 / leaf)) in
/// float, as in pcl::VoxelGrid.
class VoxelKeys {
 public:
  /// Key of points that are not finite.
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};

  /// As many bits as the extent of the cloud needs. Throws std::runtime_error if these are more than 63.
  VoxelKeys(const LabelledCloud& cloud, float leaf_m);

  int bits() const { return shifts_[2] + bits_z_; }
  std::uint64_t of(const LabelledPoint& p) const;

 private:
  float voxels_per_metre_;
  std::array<std::int64_t, 3> first_{};  ///< index of the lowest voxel
  std::array<int, 3> shifts_{};
  int bits_z_ = 0;
};

/// Zero for finite coordinates, else NaN.
inline float not_finite(const LabelledPoint& p) {
  return p.x * 0 + p.y * 0 + p.z * 0;
}

inline std::uint64_t VoxelKeys::of(const LabelledPoint& p) const {
  if (!(not_finite(p) == 0)) return kNone;
  // floor() without the call that it is on processors of the baseline.
  const auto index = [&](float value, std::size_t axis) {
    const float voxels = value * voxels_per_metre_;
    const auto towards_zero = static_cast<std::int64_t>(voxels);
    return static_cast<std::uint64_t>(towards_zero - (static_cast<float>(towards_zero) > voxels ? 1 : 0) -
                                      first_[axis]);
  };
  return index(p.x, 0) | index(p.y, 1) << shifts_[1] | index(p.z, 2) << shifts_[2];
}

}  // namespace sediment::voxel
