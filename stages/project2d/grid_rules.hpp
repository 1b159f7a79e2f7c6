#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/artifacts/grid_map.hpp"

namespace sediment::project2d {

/// An occupied cell without an occupied cell among its 8 neighbours, on which fewer than `least_points`
/// points of the band stand, becomes unknown: noise, not furniture. `in_band` counts the points of each cell.
/// Returns how many there were. 0 and 1 change nothing.
std::size_t remove_speckle(GridMap& map, std::span<const std::int32_t> in_band, int least_points);

/// Unknown cells become free where they hang together (by edges) in at most `most_cells`, do not touch the
/// border of the map, and all cells around them are free: nothing that stands on the ground is so small and
/// seen from no side. Returns how many cells. 0 changes nothing.
std::size_t fill_holes(GridMap& map, int most_cells);

/// Unknown cells become free where no 3 x 3 cells without a free one hold them (the closing of what is free),
/// unless one of their 8 neighbours is occupied: gaps of one or two cells, and the teeth of a border that
/// runs aslant. Cells at the border of the map stay. Returns how many cells.
std::size_t close_notches(GridMap& map);

}  // namespace sediment::project2d
