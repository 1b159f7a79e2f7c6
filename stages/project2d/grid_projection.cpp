#include "stages/project2d/grid_projection.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "stages/project2d/grid_rules.hpp"

namespace sediment::project2d {
namespace {

constexpr double kMostCells = 1 << 28;

/// Cell indices of the lower-left and upper-right corner, inclusive.
struct CellRange {
  double min_x = std::numeric_limits<double>::infinity(), min_y = min_x;
  double max_x = -min_x, max_y = -min_x;
};

bool is_finite(const LabelledPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// The points in the map frame, without those that are not finite or above the band.
std::vector<Vec3> points_in_map(const LabelledCloud& cloud, const Pose& map_from_world, double max_height_m,
                                GridStatistics& statistics) {
  std::vector<Vec3> points;
  points.reserve(cloud.size());
  for (const LabelledPoint& p : cloud) {
    if (!is_finite(p)) {
      ++statistics.not_finite;
      continue;
    }
    const Vec3 point = map_from_world * Vec3{p.x, p.y, p.z};
    if (point.z > max_height_m)
      ++statistics.points_above;
    else
      points.push_back(point);
  }
  return points;
}

CellRange range_of(const std::vector<Vec3>& points, const GridParameters& parameters) {
  CellRange range;
  for (const Vec3 p : points) {
    range.min_x = std::min(range.min_x, p.x);
    range.min_y = std::min(range.min_y, p.y);
    range.max_x = std::max(range.max_x, p.x);
    range.max_y = std::max(range.max_y, p.y);
  }
  range.min_x = std::floor((range.min_x - parameters.margin) / parameters.resolution);
  range.min_y = std::floor((range.min_y - parameters.margin) / parameters.resolution);
  range.max_x = std::floor((range.max_x + parameters.margin) / parameters.resolution);
  range.max_y = std::floor((range.max_y + parameters.margin) / parameters.resolution);
  return range;
}

GridMap empty_grid(const CellRange& range, const GridParameters& parameters) {
  const double width = range.max_x - range.min_x + 1, height = range.max_y - range.min_y + 1;
  if (width * height > kMostCells) {
    std::ostringstream message;
    message << "the grid would have " << width << " x " << height
            << " cells, more than 2^28: raise `resolution` (" << parameters.resolution
            << " m) or remove far outliers first";
    throw std::runtime_error(message.str());
  }
  GridMap map;
  map.width = static_cast<int>(width);
  map.height = static_cast<int>(height);
  map.resolution_m = parameters.resolution;
  map.origin_x_m = range.min_x * parameters.resolution;
  map.origin_y_m = range.min_y * parameters.resolution;
  map.cells.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), Cell::free);
  return map;
}

/// By cell: points in the band, and whether the ground was seen.
struct CellCounts {
  std::vector<std::int32_t> in_band;
  std::vector<std::uint8_t> ground_seen;
};

CellCounts count_points(const std::vector<Vec3>& points, const GridMap& map, const CellRange& range,
                        const GridParameters& parameters, GridStatistics& statistics) {
  CellCounts counts{std::vector<std::int32_t>(map.cells.size(), 0),
                    std::vector<std::uint8_t>(map.cells.size(), 0)};
  for (const Vec3 p : points) {
    const auto x = static_cast<std::size_t>(std::floor(p.x / parameters.resolution) - range.min_x);
    const auto y = static_cast<std::size_t>(std::floor(p.y / parameters.resolution) - range.min_y);
    const std::size_t cell = y * static_cast<std::size_t>(map.width) + x;
    if (p.z >= parameters.min_height) {
      ++statistics.points_in_band;
      ++counts.in_band[cell];
    } else {
      ++statistics.points_below;
      if (p.z > -parameters.min_height) counts.ground_seen[cell] = 1;
    }
  }
  return counts;
}

void mark_cells(GridMap& map, const CellCounts& counts, const GridParameters& parameters,
                const FreeByRays& free_by_rays) {
  tbb::parallel_for(0, map.height, [&](int y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * map.width + x;
      const auto is_free_by_rays = [&] {
        return free_by_rays && free_by_rays(map.origin_x_m + (x + 0.5) * map.resolution_m,
                                            map.origin_y_m + (y + 0.5) * map.resolution_m);
      };
      if (counts.in_band[i] >= parameters.min_points)
        map.cells[i] = Cell::occupied;
      else if (parameters.empty_cells != EmptyCells::binary && counts.ground_seen[i] == 0 &&
               !is_free_by_rays())
        map.cells[i] = Cell::unknown;
    }
  });
}

}  // namespace

GridMap project(const LabelledCloud& cloud, const Plane& ground, const GridParameters& parameters,
                GridStatistics& statistics,
                const std::function<FreeByRays(const Pose& map_from_world)>& free_by_rays_in) {
  const Pose to_map = map_from_world(ground);
  const std::vector<Vec3> points = points_in_map(cloud, to_map, parameters.max_height, statistics);
  if (points.empty())
    throw std::runtime_error("nothing to project: none of " + std::to_string(cloud.size()) +
                             " points is finite and below max_height");
  const CellRange range = range_of(points, parameters);
  GridMap map = empty_grid(range, parameters);
  map.map_from_world = to_map;

  const CellCounts counts = count_points(points, map, range, parameters, statistics);
  mark_cells(map, counts, parameters,
             parameters.empty_cells == EmptyCells::rays ? free_by_rays_in(to_map) : FreeByRays{});
  statistics.speckle = remove_speckle(map, counts.in_band, parameters.speckle_points);
  statistics.filled = fill_holes(map, parameters.max_hole_cells);
  if (parameters.close_notches) statistics.filled += close_notches(map);
  for (const Cell cell : map.cells) {
    statistics.occupied += cell == Cell::occupied ? 1 : 0;
    statistics.free += cell == Cell::free ? 1 : 0;
    statistics.unknown += cell == Cell::unknown ? 1 : 0;
  }
  return map;
}

}  // namespace sediment::project2d
