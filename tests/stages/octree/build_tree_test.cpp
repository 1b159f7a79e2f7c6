#include "stages/octree/build_tree.hpp"

#include <octomap/ColorOcTree.h>

#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <sstream>

using namespace sediment;
using namespace sediment::octree;

namespace {

/// A lattice block (its cubes are full, so that nodes are pruned), a surface and scattered points, in random
/// order.
LabelledCloud random_cloud(unsigned seed, float resolution_m) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  LabelledCloud cloud;
  for (int x = -8; x < 8; ++x)
    for (int y = -8; y < 8; ++y)
      for (int z = -4; z < 12; ++z)
        for (unsigned hits = 1 + seed % 7; hits > 0; --hits)
          cloud.push_back({.x = (x + 0.5F) * resolution_m,
                           .y = (y + 0.5F) * resolution_m,
                           .z = (z + 0.5F) * resolution_m});
  for (int i = 0; i < 4000; ++i) cloud.push_back({.x = 3 * unit(random), .y = 2 * unit(random), .z = 1.01F});
  for (int i = 0; i < 2000; ++i)
    cloud.push_back({.x = 9 * unit(random), .y = 9 * unit(random), .z = 9 * unit(random)});
  for (LabelledPoint& point : cloud) {
    point.r = static_cast<std::uint8_t>(random());
    point.g = static_cast<std::uint8_t>(random());
    point.b = static_cast<std::uint8_t>(random());
    point.label = random() % 4;
  }
  std::shuffle(cloud.begin(), cloud.end(), random);
  return cloud;
}

SemanticTree tree_of(const LabelledCloud& cloud, const Parameters& parameters) {
  return build_tree(sort_into_leaves(cloud, parameters.resolution_m).points, parameters);
}

std::string binary(octomap::ColorOcTree& tree) {
  std::stringstream stream;
  tree.writeBinary(stream);
  return stream.str();
}

struct Mean {
  double r = 0, g = 0, b = 0;
  int points = 0;
  std::map<std::uint32_t, int> labels;
};

}  // namespace

TEST_CASE("the tree has the bytes, the structure and the occupancy of OctoMap's point by point insertion") {
  const unsigned seed = GENERATE(1U, 2U, 3U, 6U);
  const float resolution_m = GENERATE(0.05F, 0.31F);
  const LabelledCloud cloud = random_cloud(seed, resolution_m);
  const SemanticTree ours = tree_of(cloud, {.resolution_m = resolution_m});
  octomap::ColorOcTree reference(resolution_m);
  for (const LabelledPoint& point : cloud)
    reference.updateNode(octomap::point3d(point.x, point.y, point.z), true);

  REQUIRE(ours.tree->size() == reference.size());
  REQUIRE(ours.tree->calcNumNodes() == reference.size());
  auto expected = reference.begin_tree();
  for (auto node = ours.tree->begin_tree(); node != ours.tree->end_tree(); ++node, ++expected) {
    REQUIRE(expected != reference.end_tree());
    REQUIRE(node.getKey() == expected.getKey());
    REQUIRE(node.getDepth() == expected.getDepth());
    REQUIRE(node->getLogOdds() == expected->getLogOdds());
    REQUIRE(node.isLeaf() == expected.isLeaf());
  }
  CHECK(expected == reference.end_tree());
  CHECK(binary(*ours.tree) == binary(reference));
}

TEST_CASE("every node has the mean colour of the points inside it, every leaf their majority label") {
  const float resolution_m = 0.05F;
  const LabelledCloud cloud = random_cloud(5, resolution_m);
  const SemanticTree ours = tree_of(cloud, {.resolution_m = resolution_m});

  std::map<std::pair<std::uint64_t, unsigned>, Mean> means;
  for (const LabelledPoint& point : cloud)
    for (unsigned depth = 1; depth <= 16; ++depth) {
      const auto key = ours.tree->coordToKey(octomap::point3d(point.x, point.y, point.z), depth);
      Mean& mean = means[{code_of(key[0], key[1], key[2]), depth}];
      mean.r += point.r;
      mean.g += point.g;
      mean.b += point.b;
      ++mean.points;
      ++mean.labels[point.label];
    }
  auto label = ours.leaf_labels.begin();
  bool pruned = false;
  for (auto node = ours.tree->begin_tree(); node != ours.tree->end_tree(); ++node) {
    if (node.getDepth() == 0) continue;
    const auto key = node.getKey();
    const Mean& mean = means.at({code_of(key[0], key[1], key[2]), node.getDepth()});
    const auto color = node->getColor();
    REQUIRE(std::abs(color.r - mean.r / mean.points) <= 0.5);
    REQUIRE(std::abs(color.g - mean.g / mean.points) <= 0.5);
    REQUIRE(std::abs(color.b - mean.b / mean.points) <= 0.5);
    if (!node.isLeaf()) continue;
    REQUIRE(label != ours.leaf_labels.end());
    REQUIRE((label->key[0] == key[0] && label->key[1] == key[1] && label->key[2] == key[2]));
    REQUIRE(label->depth == node.getDepth());
    int most = 0;
    std::uint32_t expected = 0;
    for (const auto& [id, points] : mean.labels)
      if (points > most) most = points, expected = id;
    REQUIRE(label->label == expected);
    pruned = pruned || node.getDepth() < 16;
    ++label;
  }
  CHECK(label == ours.leaf_labels.end());
  CHECK(pruned);
}

TEST_CASE("a lower maximum depth gives the leaves of that level and nothing below") {
  const LabelledCloud cloud = random_cloud(4, 0.05F);
  const SemanticTree coarse = tree_of(cloud, {.resolution_m = 0.05, .max_depth = 14});
  // Four of the smallest leaves to a side: the tree with four times the side has the same cubes.
  octomap::ColorOcTree reference(0.2);
  for (const LabelledPoint& point : cloud)
    reference.updateNode(octomap::point3d(point.x, point.y, point.z), true);
  REQUIRE(coarse.tree->getNumLeafNodes() == reference.getNumLeafNodes());
  REQUIRE(coarse.leaf_labels.size() == reference.getNumLeafNodes());
  auto leaf = coarse.tree->begin_leafs();
  for (auto expected = reference.begin_leafs(); expected != reference.end_leafs(); ++expected, ++leaf) {
    REQUIRE(leaf.getDepth() + 2 == expected.getDepth());
    REQUIRE(leaf.getSize() == Approx(expected.getSize()));
    REQUIRE((leaf.getCoordinate() - expected.getCoordinate()).norm() < 1e-4);
    REQUIRE(leaf->getLogOdds() == expected->getLogOdds());
  }
}

TEST_CASE("one point makes one leaf, equal points one more certain leaf, and no point an empty tree") {
  const LabelledCloud one{{.x = 0.01F, .y = -0.01F, .z = 2, .b = 1, .g = 2, .r = 3, .label = 56}};
  const SemanticTree single = tree_of(one, {});
  CHECK(single.tree->getNumLeafNodes() == 1);
  REQUIRE(single.leaf_labels.size() == 1);
  CHECK(single.leaf_labels[0].label == 56);
  const auto* leaf = single.tree->search(0.01, -0.01, 2);
  REQUIRE(leaf != nullptr);
  CHECK(leaf->getColor() == octomap::ColorOcTreeNode::Color(3, 2, 1));
  CHECK(leaf->getOccupancy() == Approx(0.7));

  const SemanticTree many = tree_of(LabelledCloud(100, one[0]), {});
  CHECK(many.tree->getNumLeafNodes() == 1);
  CHECK(many.tree->search(0.01, -0.01, 2)->getLogOdds() == many.tree->getClampingThresMaxLog());

  CHECK(tree_of({}, {}).tree->size() == 0);
}
