#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/scene/pose.hpp"

namespace sediment {

/// State of a cell, with the grey value map_server and nav2 read it from.
enum class Cell : std::uint8_t { occupied = 0, unknown = 205, free = 254 };

/// A 2D navigation grid. Row 0 of `cells` is the lowest y (the file has it the other way round: image row 0
/// is the top).
struct GridMap {
  int width = 0, height = 0;              ///< cells
  double resolution_m = 0.05;             ///< side of a cell
  double origin_x_m = 0, origin_y_m = 0;  ///< lower-left corner of cell (0, 0) in the map frame
  std::vector<Cell> cells;                ///< row by row, width * height
  Pose map_from_world;                    ///< map frame: ground plane is z = 0, z is up
  std::string ground_source;              ///< how the ground was found: "given", "ransac", ...

  Cell& at(int x, int y) { return cells[static_cast<std::size_t>(y) * width + x]; }
  Cell at(int x, int y) const { return cells[static_cast<std::size_t>(y) * width + x]; }
};

/// Writes the `grid-map` artifact: map.pgm, map.yaml (free_thresh 0.19, so that 205 loads as unknown),
/// ground.json (map_from_world as 4x4, plane in world coordinates, source). Throws std::runtime_error that
/// names the file.
void write_grid_map(const std::filesystem::path& folder, const GridMap& map);

/// Cell of a cost mask about which nothing is known; costs are 0 .. 100.
inline constexpr std::uint8_t kNoCost = 255;

/// Adds costs.pgm and costs.yaml to a grid map: one cost a cell, in the order of `map.cells`, as a map of
/// mode "raw", which nav2 loads as a filter mask: 0 .. 100 are costs, 255 is unknown. Throws
/// std::runtime_error that names the file.
void write_cost_mask(const std::filesystem::path& folder, const GridMap& map,
                     const std::vector<std::uint8_t>& costs);

/// Reads it as map_server does (thresholds, negate, origin). Throws std::runtime_error that names the file.
GridMap read_grid_map(const std::filesystem::path& folder);

}  // namespace sediment
