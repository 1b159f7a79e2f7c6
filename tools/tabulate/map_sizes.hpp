#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/tabulate/run_facts.hpp"

namespace sediment::tabulate {

/// Sizes of the maps of one instance, and the parameters they depend on.
struct MapSizes {
  std::string sequence;
  std::string density;  ///< which frames were fused, in words
  double leaf_m = 0, resolution_m = 0;
  double dense = 0, after_sor = 0, after_voxel = 0, tree = 0, tree_binary = 0;  ///< bytes
  double dense_points = 0, sor_points = 0, voxel_points = 0, leaves = 0;
  double frames_fused = 0;
  std::string settings;  ///< all other parameters that matter, in words
  std::string receipts;  ///< of fuse, sor, voxel and octree

  double reduced() const { return after_voxel / dense; }
  double removed_by_sor() const { return 1 - sor_points / dense_points; }
};

/// The instances that have all of fuse, sor, voxel and octree.
std::vector<MapSizes> map_sizes(std::span<const RunFacts> facts);

}  // namespace sediment::tabulate
