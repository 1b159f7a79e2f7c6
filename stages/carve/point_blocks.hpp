#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/labelled_point.hpp"
#include "pipeline/scene/pose.hpp"

namespace sediment::carve {

/// What a camera can see: all of it lies between two depths and within these bounds of x/z and y/z.
struct Frustum {
  double min_depth_m = 0, max_depth_m = 0;
  std::array<double, 2> x{}, y{};
};
Frustum frustum_of(const Camera& camera, double min_depth_m, double max_depth_m);

/// Consecutive points that lie near each other: the finite ones within a sphere. NaN if there is none.
struct Block {
  std::size_t begin = 0, end = 0;
  Vec3 centre_m;
  double radius_m = 0;

  /// Whether one of its points may be in sight. Those that are not finite never are.
  bool may_be_in(const Frustum& frustum, const Pose& camera_from_world) const;
};

/// The points of a cloud, reordered so that neighbours in space are neighbours in memory.
struct PointBlocks {
  LabelledCloud points;
  std::vector<std::uint32_t> order;  ///< points[i] was point order[i] of the cloud
  std::vector<Block> blocks;         ///< all of the points
};

/// Sorts a cloud by cells of 25 cm. Deterministic. Throws std::length_error from 2^32 points on.
PointBlocks blocks_of(const LabelledCloud& cloud);

}  // namespace sediment::carve
