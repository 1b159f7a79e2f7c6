#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "stages/sor/nearest_kernel.hpp"
#include "stages/sor/position.hpp"
#include "stages/sor/spatial_order.hpp"

namespace sediment::sor {

/// Points in spatial order with a pyramid of boxes over their leaves: a node of level l + 1 covers kFanOut
/// consecutive nodes of level l, level 0 are the leaves, the last level has one node.
struct PointTree {
  static constexpr std::size_t kFanOut = 8;
  static constexpr std::size_t kPadding = 16;  ///< floats that may be read behind the last point

  std::size_t size = 0;
  std::array<std::vector<float>, 3> axes;  ///< x, y, z in spatial order, padded
  SpatialOrder order;

  /// One level of boxes, padded with empty ones to a multiple of kFanOut.
  struct Level {
    std::array<std::vector<float>, 3> min, max;

    std::size_t size() const { return min[0].size(); }
    Box box(std::size_t node) const {
      return {{min[0][node], min[1][node], min[2][node]}, {max[0][node], max[1][node], max[2][node]}};
    }
    BoxArrays arrays() const {
      return {{min[0].data(), min[1].data(), min[2].data()}, {max[0].data(), max[1].data(), max[2].data()}};
    }
  };
  std::vector<Level> levels;

  std::size_t leaf_count() const { return order.leaf_begin.size() - 1; }
  std::size_t leaf_begin(std::size_t leaf) const { return order.leaf_begin[leaf]; }
  std::size_t leaf_size(std::size_t leaf) const {
    return order.leaf_begin[leaf + 1] - order.leaf_begin[leaf];
  }
  Position point(std::size_t i) const { return {axes[0][i], axes[1][i], axes[2][i]}; }
};

PointTree build_point_tree(std::span<const Position> points, std::size_t leaf_points);

}  // namespace sediment::sor
