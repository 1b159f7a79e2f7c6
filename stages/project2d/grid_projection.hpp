#pragma once

#include <cstddef>

#include "pipeline/artifacts/grid_map.hpp"
#include "pipeline/scene/labelled_point.hpp"
#include "stages/project2d/plane.hpp"

namespace sediment::project2d {

/// What a cell without an obstacle is. `binary` as in the paper: free. `seen`: free only if the cloud has a
/// point of the ground there, else unknown.
enum class EmptyCells { binary, seen };

struct GridParameters {
  double resolution = 0.05;  ///< metres
  double min_height = 0.1;   ///< metres above the ground; what is lower can be driven over
  double max_height = 1.8;   ///< metres above the ground; what is higher can be driven under
  int min_points = 1;        ///< of the band, for a cell to be occupied
  double margin = 0.25;      ///< metres around the cloud
  EmptyCells empty_cells = EmptyCells::binary;
};

struct GridStatistics {
  std::size_t points_below = 0, points_in_band = 0, points_above = 0, not_finite = 0;
  std::size_t occupied = 0, free = 0, unknown = 0;  ///< cells
};

/// Passes the points between min_height and max_height above the ground and marks the cells they stand on.
/// The grid covers the whole cloud up to max_height, whole multiples of the resolution. Throws
/// std::runtime_error if there is no such point or the grid would have more than 2^28 cells.
GridMap project(const LabelledCloud& cloud, const Plane& ground, const GridParameters& parameters,
                GridStatistics& statistics);

}  // namespace sediment::project2d
