#include "stages/project2d/free_columns.hpp"

#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "pipeline/artifacts/octree.hpp"

namespace sediment::project2d {

LabelledCloud occupied_cells(const octomap::ColorOcTree& tree, const std::filesystem::path& folder) {
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> labels;
  if (std::filesystem::exists(folder / "leaf_labels.csv"))
    for (const LeafLabel& leaf : read_leaf_labels(folder))
      labels[{leaf.key[0], leaf.key[1], leaf.key[2], leaf.depth}] = leaf.label;
  LabelledCloud cells;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const octomap::OcTreeKey key = leaf.getIndexKey();
    const auto label = labels.find({key[0], key[1], key[2], leaf.getDepth()});
    LabelledPoint point;
    if (label != labels.end()) point.label = label->second;
    const int side = 1 << (tree.getTreeDepth() - leaf.getDepth());
    const double first = -(side - 1) / 2.0 * tree.getResolution();
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          point.x = static_cast<float>(leaf.getX() + first + x * tree.getResolution());
          point.y = static_cast<float>(leaf.getY() + first + y * tree.getResolution());
          point.z = static_cast<float>(leaf.getZ() + first + z * tree.getResolution());
          cells.push_back(point);
        }
  }
  if (cells.empty()) throw std::runtime_error(folder.string() + ": no occupied leaf in the octree");
  return cells;
}

FreeColumns::FreeColumns(const octomap::ColorOcTree& tree, const Pose& map_from_world)
    : tree_(tree), world_from_map_(map_from_world.inverse()) {}

double FreeColumns::free_share(double x_m, double y_m, double low_m, double high_m) const {
  const int samples = std::max(1, static_cast<int>(std::ceil((high_m - low_m) / tree_.getResolution())));
  int free = 0;
  for (int i = 0; i < samples; ++i) {
    const Vec3 p = world_from_map_ * Vec3{x_m, y_m, low_m + (i + 0.5) * (high_m - low_m) / samples};
    const octomap::ColorOcTreeNode* node = tree_.search(p.x, p.y, p.z);
    free += node != nullptr && !tree_.isNodeOccupied(node) ? 1 : 0;
  }
  return static_cast<double>(free) / samples;
}

std::function<FreeByRays(const Pose& map_from_world)> free_by_rays(const octomap::ColorOcTree* tree,
                                                                   const GridParameters& parameters) {
  if (tree == nullptr) return {};
  return [=](const Pose& map_from_world) {
    return [=, columns = FreeColumns(*tree, map_from_world)](double x_m, double y_m) {
      const double low_m = parameters.min_height, foot_m = parameters.free_foot_m;
      return (foot_m > 0 && columns.free_share(x_m, y_m, low_m, low_m + foot_m) == 1) ||
             columns.free_share(x_m, y_m, low_m, parameters.max_height) >= parameters.min_free_share;
    };
  };
}

}  // namespace sediment::project2d
