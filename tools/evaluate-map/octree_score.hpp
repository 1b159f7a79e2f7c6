#pragma once

#include <filesystem>
#include <optional>

#include "tools/evaluate-map/true_surfaces.hpp"

namespace octomap {
class ColorOcTree;
}

namespace sediment::tools {

/// Occupied space of a tree as the centres of its finest cells, with the labels of their leaves.
LabelledCloud occupied_cells(const octomap::ColorOcTree& tree, const std::filesystem::path& folder);

/// Occupancy of a tree against the truth. A figure without anything to compute it from is none.
struct OctreeScore {
  double resolution_m = 0;
  std::size_t occupied_cells = 0;
  std::optional<double>
      occupied_precision;  ///< occupied cells that have a true surface within one cell (of 26)
  std::optional<double>
      occupied_recall;  ///< true cells that never move and are occupied, or a face neighbour is
  std::optional<double> free_precision;  ///< of the places that are free in the tree and known: truly free
  std::optional<double> free_recall;     ///< of the truly free places: free in the tree
};

/// `still` and `surface` are true points, `truth_from_map` brings the tree into their world. Free space is
/// compared at the centres of cells of 10 cm in the box around `still` and the cameras, outside true surfaces
/// where it was seen through.
OctreeScore octree_score(const octomap::ColorOcTree& tree, const LabelledCloud& occupied,
                         const Pose& truth_from_map, const std::vector<Vec3>& still,
                         const std::vector<Vec3>& surface, const FreeSpace& free);

}  // namespace sediment::tools
