#pragma once

#include <cstddef>
#include <functional>

#include "pipeline/artifacts/grid_map.hpp"
#include "pipeline/scene/labelled_point.hpp"
#include "stages/project2d/plane.hpp"

namespace sediment::project2d {

/// What a cell without an obstacle is. `binary` as in the paper: free. `seen`: free only if the cloud has a
/// point of the ground there, else unknown. `rays`: free also if rays found enough of the band free.
enum class EmptyCells { binary, seen, rays };

/// Whether rays found a place of the map, metres, free.
using FreeByRays = std::function<bool(double x_m, double y_m)>;

struct GridParameters {
  double resolution = 0.05;  ///< metres
  double min_height = 0.1;   ///< metres above the ground; what is lower can be driven over
  double max_height = 1.8;   ///< metres above the ground; what is higher can be driven under
  int min_points = 1;        ///< of the band, for a cell to be occupied
  double margin = 0.25;      ///< metres around the cloud
  EmptyCells empty_cells = EmptyCells::binary;
  double min_free_share = 0.5;  ///< of the band, for a cell to be free by rays
  double free_foot_m = 0;       ///< or so much of the band's lower end, all of it; 0: only the share counts
  int speckle_points = 0;       ///< lone cells with fewer points in the band are no obstacles; 0: none
  int max_hole_cells = 0;       ///< unknown cells amid free ones that become free; 0: none
  bool close_notches = false;   ///< unknown cells between free ones, in gaps of one or two, become free
};

struct GridStatistics {
  std::size_t points_below = 0, points_in_band = 0, points_above = 0, not_finite = 0;
  std::size_t occupied = 0, free = 0, unknown = 0;  ///< cells
  std::size_t speckle = 0, filled = 0;              ///< cells that the rules changed
};

/// Passes the points between min_height and max_height above the ground and marks the cells they stand on.
/// The grid covers the whole cloud up to max_height, whole multiples of the resolution. Throws
/// std::runtime_error if there is no such point or the grid would have more than 2^28 cells.
/// `free_by_rays_in` makes the function that EmptyCells::rays asks, given the transform of the map; it is
/// called from several threads.
GridMap project(const LabelledCloud& cloud, const Plane& ground, const GridParameters& parameters,
                GridStatistics& statistics,
                const std::function<FreeByRays(const Pose& map_from_world)>& free_by_rays_in = {});

}  // namespace sediment::project2d
