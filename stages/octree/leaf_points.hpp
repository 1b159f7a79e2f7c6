#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::octree {

/// OctoMap's depth of a tree: keys have 16 bits an axis, and the origin is key 32768.
inline constexpr int kTreeDepth = 16;

/// A point as the tree sees it.
struct LeafPoint {
  std::uint64_t code = 0;  ///< bits of the three keys interleaved, x lowest: three bits a level, root first
  std::uint8_t b = 0, g = 0, r = 0;
  std::uint32_t label = kUnlabelled;
};

/// Key of a coordinate in metres along one axis: floor(x / resolution) + 32768, as OctoMap computes it.
/// Throws std::runtime_error that names the coordinate and the range if it lies outside the tree.
std::uint16_t key_of(float coordinate_m, double resolution_m);

std::uint64_t code_of(std::uint16_t key_x, std::uint16_t key_y, std::uint16_t key_z);

/// The three keys back: x, y, z.
struct Keys {
  std::uint16_t x = 0, y = 0, z = 0;
};
Keys keys_of(std::uint64_t code);

/// The points in the order of their codes, equal codes in the order of the cloud: the points of any node of
/// the tree are neighbours. Points that are not finite are left out and counted. Throws std::runtime_error
/// for points outside the tree. The result does not depend on the number of threads.
struct SortedPoints {
  std::vector<LeafPoint> points;
  std::size_t not_finite = 0;
};
SortedPoints sort_into_leaves(std::span<const LabelledPoint> cloud, double resolution_m);

}  // namespace sediment::octree
