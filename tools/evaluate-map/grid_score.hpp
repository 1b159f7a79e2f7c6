#pragma once

#include <optional>

#include "pipeline/artifacts/grid_map.hpp"
#include "tools/evaluate-map/true_surfaces.hpp"

namespace sediment::tools {

/// Heights above the ground that a robot could run into; as the defaults of project2d.
struct HeightBand {
  double low_m = 0.1, high_m = 1.8;
};

/// A navigation grid against the truth, whose ground is z = 0 and whose z is up. A cell is truly occupied if
/// a true surface is in the band above it; truly free if it is not and the ground was seen there (a point
/// that never moves below the band), or if the band above it was seen through. Others are not known. An
/// obstacle may be one cell (of 8) off.
struct GridScore {
  std::size_t occupied = 0, free = 0, unknown = 0;  ///< cells of the map
  std::size_t true_occupied = 0, true_free = 0;     ///< cells of the truth within the map
  std::optional<double> free_precision;  ///< free and known: no obstacle there that the map does not have
  std::optional<double> free_precision_strict;  ///< free and known: truly free
  std::optional<double> free_recall;            ///< truly free by its ground: free in the map
  std::optional<double> free_unobserved;        ///< free in the map, but not known
  std::optional<double> occupied_precision, occupied_recall;
  double tilt_deg = 0,
         ground_offset_m = 0;  ///< of the map's ground against the true one, below the middle of the map
};

GridScore grid_score(const GridMap& map, const Pose& truth_from_world, const std::vector<Vec3>& still,
                     const std::vector<Vec3>& surface, const FreeSpace& free, const HeightBand& band = {});

}  // namespace sediment::tools
