#include <octomap/ColorOcTree.h>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/contract/stage.hpp"
#include "stages/octree/build_tree.hpp"

using namespace sediment;
using namespace sediment::octree;

int main(int argc, char** argv) {
  Parameters parameters;
  contract::Stage stage("octree", "Semantic octree of the occupied space");
  stage.reads("cloud", contract::kind::kCloud, "points of the map");
  stage.writes("octree", contract::kind::kOctree,
               "map.ot (colour), map.bt (occupancy), labels of the leaves");
  stage.tunes("resolution_m", parameters.resolution_m, "side of the smallest leaf", {0.001, 100});
  stage.tunes("max_depth", parameters.max_depth,
              "levels of the tree; each one less doubles the smallest leaf", {1, kTreeDepth});

  return stage.run(argc, argv, [&](contract::Work& work) {
    const LabelledCloud cloud = read_cloud(work.in("cloud"));
    const SortedPoints sorted = sort_into_leaves(cloud, parameters.resolution_m);
    if (sorted.points.empty())
      throw std::runtime_error(work.in("cloud").string() + ": no finite point among " +
                               std::to_string(cloud.size()));
    SemanticTree semantic = build_tree(sorted.points, parameters);
    write_octree(work.out(), *semantic.tree, semantic.leaf_labels, read_cloud_labels(work.in("cloud")));
    work.metrics() = {{"points", sorted.points.size()},
                      {"points_not_finite", sorted.not_finite},
                      {"leaves", semantic.leaf_labels.size()},
                      {"nodes", semantic.tree->size()}};
  });
}
