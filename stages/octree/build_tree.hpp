#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pipeline/artifacts/octree.hpp"
#include "stages/octree/leaf_belief.hpp"
#include "stages/octree/leaf_points.hpp"
#include "stages/octree/ray_map.hpp"

namespace octomap {
class ColorOcTree;
}

namespace sediment::octree {

/// What an occupied leaf is painted with.
enum class LeafColor {
  image,  ///< the mean colour of its points
  label   ///< the colour of its label; unlabelled: grey
};

struct Parameters {
  double resolution_m = 0.05;  ///< side of the smallest leaf
  int max_depth = kTreeDepth;  ///< levels below the root; each one less doubles the side of the smallest leaf
  LabelParameters labels{};
  LeafColor color = LeafColor::image;
};

/// The tree and what OctoMap's format cannot hold.
struct SemanticTree {
  std::unique_ptr<octomap::ColorOcTree> tree;
  std::vector<LeafLabel> leaf_labels;  ///< one per occupied leaf, in the order of OctoMap's leaf iterator
};

/// Builds the tree of section 3.3.4 from points sorted by code. It has the structure and the occupancy that
/// ColorOcTree::updateNode(point, true) for every point leaves, in whatever order: each point is one hit,
/// values are clamped, inner nodes have the maximum of their children, eight equal leaves are pruned to one.
/// Colours differ from OctoMap's, whose running mean depends on the order of the points: here every node has
/// the mean of all points inside it, rounded.
///
/// `cells`, in the order of their codes, are what rays say. `Occupied::by_cloud`: a leaf with points is
/// occupied as without them, and the cells, which must be free (free_cells), are the other leaves.
/// `Occupied::by_rays`: they say the occupancy of every leaf that they know, as OctoMap's insertion of all
/// frames does; points colour and label it.
enum class Occupied { by_cloud, by_rays };
SemanticTree build_tree(std::span<const LeafPoint> points, std::span<const SpaceCell> cells,
                        Occupied occupied, const Parameters& parameters, const LabelTable& table = {});

/// Without rays.
inline SemanticTree build_tree(std::span<const LeafPoint> points, const Parameters& parameters) {
  return build_tree(points, {}, Occupied::by_cloud, parameters);
}

}  // namespace sediment::octree
