#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stages/sor/spatial_order.hpp"

namespace sediment::sor {

/// Positions as three arrays.
struct Positions {
  std::vector<float> x, y, z;
};

/// Points in spatial order with a pyramid of boxes over their leaves: a node of level l + 1 covers kFanOut
/// consecutive nodes of level l, level 0 are the leaves, the last level has one node.
struct PointTree {
  static constexpr std::size_t kFanOut = 8;

  Positions points;  ///< in spatial order
  SpatialOrder order;
  std::vector<std::vector<Box>> levels;

  std::size_t leaf_count() const { return order.leaf_begin.size() - 1; }
  std::size_t leaf_begin(std::size_t leaf) const { return order.leaf_begin[leaf]; }
  std::size_t leaf_size(std::size_t leaf) const {
    return order.leaf_begin[leaf + 1] - order.leaf_begin[leaf];
  }
};

PointTree build_point_tree(std::span<const Position> points, std::size_t leaf_points);

/// Appends the leaves whose box is within `distance` of the box, in ascending order.
void leaves_near(const PointTree& tree, const Box& box, float distance, std::vector<std::uint32_t>& leaves);

}  // namespace sediment::sor
