#include "tools/evaluate-map/octree_score.hpp"

#include <octomap/ColorOcTree.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "pipeline/artifacts/octree.hpp"
#include "tools/truth/share.hpp"

namespace sediment::tools {
namespace {

constexpr double kProbe_m = 0.1;  ///< distance of the places where free space is compared

Vec3 position_of(const LabelledPoint& point) {
  return {point.x, point.y, point.z};
}

/// Centres of the cells of a box around points.
std::vector<Vec3> probes_around(const std::vector<Vec3>& points) {
  const VoxelSet grid(kProbe_m);
  Voxel low = grid.voxel_of(points.front()), high = low;
  for (const Vec3& point : points) {
    const Voxel v = grid.voxel_of(point);
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  std::vector<Vec3> probes;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) probes.push_back(grid.center_of({x, y, z}));
  return probes;
}

void add_free_space(OctreeScore& score, const octomap::ColorOcTree& tree, const Pose& map_from_truth,
                    const std::vector<Vec3>& still, const VoxelSet& surface, const FreeSpace& free) {
  std::vector<Vec3> room = free.viewpoints();
  room.insert(room.end(), still.begin(), still.end());
  const std::vector<Vec3> probes = probes_around(room);
  enum State : char { kUnknown, kFree, kOccupied };
  std::vector<State> truth(probes.size(), kUnknown), found(probes.size(), kUnknown);
  tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t i) {
    const Voxel voxel = surface.voxel_of(probes[i]);
    if (surface.contains(voxel))
      truth[i] = kOccupied;
    else if (!surface.contains_near(voxel) && free.contains(probes[i]))
      truth[i] = kFree;
    const Vec3 at = map_from_truth * probes[i];
    const auto* node = tree.search(at.x, at.y, at.z);
    if (node != nullptr) found[i] = tree.isNodeOccupied(node) ? kOccupied : kFree;
  });
  std::size_t truly_free = 0, found_free = 0, both = 0;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    truly_free += truth[i] == kFree;
    found_free += found[i] == kFree && truth[i] != kUnknown;
    both += truth[i] == kFree && found[i] == kFree;
  }
  score.free_precision = share(both, found_free);
  score.free_recall = share(both, truly_free);
}

}  // namespace

LabelledCloud occupied_cells(const octomap::ColorOcTree& tree, const std::filesystem::path& folder) {
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> label_of;
  if (std::filesystem::exists(folder / "leaf_labels.csv"))
    for (const LeafLabel& leaf : read_leaf_labels(folder))
      label_of[{leaf.key[0], leaf.key[1], leaf.key[2], leaf.depth}] = leaf.label;
  LabelledCloud cells;
  const double side_m = tree.getResolution();
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const octomap::OcTreeKey key = leaf.getIndexKey();
    const auto label = label_of.find({key[0], key[1], key[2], leaf.getDepth()});
    const int cells_along = 1 << (tree.getTreeDepth() - leaf.getDepth());
    const double first = -(cells_along - 1) / 2.0 * side_m;
    LabelledPoint point;
    point.label = label == label_of.end() ? kUnlabelled : label->second;
    for (int z = 0; z < cells_along; ++z)
      for (int y = 0; y < cells_along; ++y)
        for (int x = 0; x < cells_along; ++x) {
          point.x = static_cast<float>(leaf.getX() + first + x * side_m);
          point.y = static_cast<float>(leaf.getY() + first + y * side_m);
          point.z = static_cast<float>(leaf.getZ() + first + z * side_m);
          cells.push_back(point);
        }
  }
  return cells;
}

OctreeScore octree_score(const octomap::ColorOcTree& tree, const LabelledCloud& occupied,
                         const Pose& truth_from_map, const std::vector<Vec3>& still,
                         const std::vector<Vec3>& surface, const FreeSpace& free) {
  OctreeScore score;
  score.resolution_m = tree.getResolution();
  score.occupied_cells = occupied.size();
  // Cells are compared in the tree's own grid: the truth is brought into its world.
  const Pose map_from_truth = truth_from_map.inverse();
  VoxelSet cells(score.resolution_m), true_surface(score.resolution_m), true_still(score.resolution_m);
  for (const LabelledPoint& cell : occupied) cells.insert(position_of(cell));
  for (const Vec3& point : surface) true_surface.insert(map_from_truth * point);
  for (const Vec3& point : still) true_still.insert(map_from_truth * point);
  std::size_t right = 0, kept = 0;
  for (const Voxel voxel : cells.sorted()) right += true_surface.contains_near(voxel);
  for (const Voxel voxel : true_still.sorted()) kept += cells.contains_or_face(voxel);
  score.occupied_precision = share(right, cells.size());
  score.occupied_recall = share(kept, true_still.size());
  VoxelSet near(0.05);
  for (const Vec3& point : surface) near.insert(point);
  add_free_space(score, tree, map_from_truth, still, near, free);
  return score;
}

}  // namespace sediment::tools
