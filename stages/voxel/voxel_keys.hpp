#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::voxel {

/// Points with the voxel each one is in.
struct KeyedPoints {
  std::vector<std::uint64_t> keys;       ///< ascending; z counts most, then y, then x, as in PCL's order
  std::vector<std::uint32_t> point_idx;  ///< of the cloud; ascending within a voxel
};

/// Sorts the points with finite coordinates by voxel. A voxel holds [i * leaf, (i + 1) * leaf) along each
/// axis, from the origin of the world on; the index is floor(x * (1 / leaf)) in float, as in pcl::VoxelGrid.
KeyedPoints sort_into_voxels(const LabelledCloud& cloud, float leaf_m);

}  // namespace sediment::voxel
