#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/artifacts/grid_map.hpp"
#include "pipeline/scene/labelled_point.hpp"

namespace sediment::project2d {

/// What it costs a robot to be where something of a class is: 0 nothing .. 100 never.
struct ClassCosts {
  std::map<std::string, int> of_class;
  int otherwise = 0;    ///< of classes that are not named, and of what is unlabelled
  int reach_cells = 0;  ///< cells around a cell that cost the same
};

/// Reads the YAML mapping {costs: {class: 0..100, ...}, default: 0..100, reach_cells: n}. Throws
/// std::runtime_error with file and line.
ClassCosts read_class_costs(const std::filesystem::path& file);

/// For each cell of the map the highest cost of a class that has at least `min_points` points there, up to
/// `max_height_m` above the ground; kNoCost where no point is.
std::vector<std::uint8_t> cost_mask(const GridMap& map, const LabelledCloud& cloud, const LabelTable& labels,
                                    const ClassCosts& costs, double max_height_m, int min_points);

}  // namespace sediment::project2d
