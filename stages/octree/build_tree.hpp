#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pipeline/artifacts/octree.hpp"
#include "stages/octree/leaf_points.hpp"

namespace octomap {
class ColorOcTree;
}

namespace sediment::octree {

struct Parameters {
  double resolution_m = 0.05;  ///< side of the smallest leaf
  int max_depth = kTreeDepth;  ///< levels below the root; each one less doubles the side of the smallest leaf
};

/// The tree and what OctoMap's format cannot hold.
struct SemanticTree {
  std::unique_ptr<octomap::ColorOcTree> tree;
  std::vector<LeafLabel> leaf_labels;  ///< one per leaf, in the order of OctoMap's leaf iterator
};

/// Builds the tree of section 3.3.4 from points sorted by code. It has the structure and the occupancy that
/// ColorOcTree::updateNode(point, true) for every point leaves, in whatever order: each point is one hit,
/// values are clamped, inner nodes have the maximum of their children, eight equal leaves are pruned to one.
/// Colours differ from OctoMap's, whose running mean depends on the order of the points: here every node has
/// the mean of all points inside it, rounded. The label of a leaf is that of most of its points, the smallest
/// id where several are as many.
SemanticTree build_tree(std::span<const LeafPoint> sorted, const Parameters& parameters);

}  // namespace sediment::octree
