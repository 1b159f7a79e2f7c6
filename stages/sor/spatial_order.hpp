#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stages/sor/position.hpp"

namespace sediment::sor {

/// Points in an order in which neighbours in space are mostly neighbours in memory, cut into leaves.
struct SpatialOrder {
  std::vector<std::uint32_t> point_idx;  ///< of the input, in the new order
  std::vector<std::uint32_t>
      leaf_begin;  ///< leaf i is [leaf_begin[i], leaf_begin[i + 1]); the last entry is the number of points
};

/// Sorts finite points along a Morton curve and cuts the curve at the borders of its cells into leaves of at
/// most `leaf_points` points. Only a leaf whose points are all at one place may hold more. Cells that are
/// still too full at the finest level of the curve (a far outlier stretches it) are sorted again on a curve
/// of their own.
SpatialOrder spatial_order(std::span<const Position> points, std::size_t leaf_points);

}  // namespace sediment::sor
