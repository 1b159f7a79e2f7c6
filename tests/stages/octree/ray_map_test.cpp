#include "stages/octree/ray_map.hpp"

#include <octomap/ColorOcTree.h>
#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "stages/octree/build_tree.hpp"
#include "tests/synthetic/synthetic_sequence.hpp"

using namespace sediment;
using namespace sediment::octree;

namespace {

octomap::point3d center_of(const octomap::ColorOcTree& tree, const Keys& keys) {
  return tree.keyToCoord(octomap::OcTreeKey(keys.x, keys.y, keys.z));
}

octomap::point3d octomap_point(Vec3 p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// One frame as OctoMap inserts it, but that ends which do not fill are left alone.
void insert(octomap::ColorOcTree& tree, Vec3 origin, const std::vector<RayEnd>& ends) {
  octomap::Pointcloud all, filling;
  for (const RayEnd& end : ends) {
    all.push_back(center_of(tree, end.keys));
    if (end.fills) filling.push_back(center_of(tree, end.keys));
  }
  octomap::KeySet free, ends_of_all, occupied, ignored;
  tree.computeDiscreteUpdate(all, octomap_point(origin), free, ends_of_all, -1);
  tree.computeDiscreteUpdate(filling, octomap_point(origin), ignored, occupied, -1);
  // OctoMap takes every end out of the free cells; one that does not fill stays free if another ray passes.
  octomap::KeyRay ray;
  for (const octomap::OcTreeKey& key : ends_of_all) {
    tree.computeRayKeys(octomap_point(origin), tree.keyToCoord(key), ray);
    for (const octomap::OcTreeKey& cell : ray)
      if (occupied.find(cell) == occupied.end()) free.insert(cell);
  }
  for (const octomap::OcTreeKey& key : free) tree.updateNode(key, false);
  for (const octomap::OcTreeKey& key : occupied) tree.updateNode(key, true);
}

void require_equal(octomap::ColorOcTree& ours, octomap::ColorOcTree& reference) {
  REQUIRE(ours.size() == reference.size());
  auto expected = reference.begin_tree();
  for (auto node = ours.begin_tree(); node != ours.end_tree(); ++node, ++expected) {
    REQUIRE(node.getKey() == expected.getKey());
    REQUIRE(node.getDepth() == expected.getDepth());
    REQUIRE(node->getLogOdds() == expected->getLogOdds());
  }
}

std::vector<std::vector<RayEnd>> frames_of(const test::SyntheticSequence& sequence, double resolution_m,
                                           bool dynamic) {
  const std::vector<Ray> rays = rays_of(sequence.camera);
  std::vector<std::vector<RayEnd>> frames;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i)
    frames.push_back(ray_ends({sequence.groundtruth[i].world_from_camera, sequence.frames[i].depth,
                               dynamic ? sequence.dynamic[i] : cv::Mat{}},
                              sequence.camera, rays, {}, resolution_m));
  return frames;
}

}  // namespace

TEST_CASE("rays of a walking scene leave the tree that OctoMap's discretised insertion leaves") {
  const double resolution_m = GENERATE(0.1, 0.05, 0.037);
  const auto sequence = test::synthetic_sequence({.frames = 4, .rate_hz = 5});
  octomap::ColorOcTree reference(resolution_m);
  RayMap map(reference);
  const auto frames = frames_of(sequence, resolution_m, false);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3 origin = sequence.groundtruth[i].world_from_camera.translation;
    octomap::Pointcloud cloud;
    for (const RayEnd& end : frames[i])
      if (end.fills) cloud.push_back(center_of(reference, end.keys));
    const std::vector<RayEnd> filling = [&] {
      std::vector<RayEnd> kept;
      for (const RayEnd& end : frames[i])
        if (end.fills) kept.push_back(end);
      return kept;
    }();
    reference.insertPointCloud(cloud, octomap_point(origin), -1, false, true);
    map.add(cells_of_rays(origin, filling, resolution_m));
  }
  SemanticTree ours = build_tree({}, map.cells(), Occupied::by_rays, {.resolution_m = resolution_m});
  require_equal(*ours.tree, reference);
}

TEST_CASE("rays of dynamic pixels and of far ones clear their way and fill nothing") {
  const double resolution_m = 0.1;
  const auto sequence = test::synthetic_sequence({.frames = 4, .rate_hz = 3});
  octomap::ColorOcTree reference(resolution_m);
  RayMap map(reference);
  const auto frames = frames_of(sequence, resolution_m, true);
  std::size_t not_filling = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3 origin = sequence.groundtruth[i].world_from_camera.translation;
    insert(reference, origin, frames[i]);
    map.add(cells_of_rays(origin, frames[i], resolution_m));
    for (const RayEnd& end : frames[i]) not_filling += end.fills ? 0 : 1;
  }
  CHECK(not_filling > 500);
  SemanticTree ours = build_tree({}, map.cells(), Occupied::by_rays, {.resolution_m = resolution_m});
  require_equal(*ours.tree, reference);
}

TEST_CASE(
    "random rays of all lengths and directions, along axes too, meet the cells that OctoMap's rays meet") {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> offset(-40, 40);
  for (int trial = 0; trial < 20; ++trial) {
    const double resolution_m = 0.02 + 0.013 * trial;
    octomap::ColorOcTree reference(resolution_m);
    const Vec3 origin{0.001 * offset(random), 0.01 * offset(random), trial % 3 == 0 ? 0 : 1.0};
    const auto key = reference.coordToKey(octomap_point(origin));
    std::vector<RayEnd> ends;
    for (int i = 0; i < 300; ++i) {
      const int dx = i % 5 == 0 ? 0 : offset(random), dy = i % 7 == 0 ? 0 : offset(random);
      const int dz = i % 3 == 0 ? 0 : offset(random);
      ends.push_back({{static_cast<std::uint16_t>(key[0] + dx), static_cast<std::uint16_t>(key[1] + dy),
                       static_cast<std::uint16_t>(key[2] + dz)},
                      i % 4 != 0});
    }
    insert(reference, origin, ends);
    RayMap map(reference);
    map.add(cells_of_rays(origin, ends, resolution_m));
    SemanticTree ours = build_tree({}, map.cells(), Occupied::by_rays, {.resolution_m = resolution_m});
    require_equal(*ours.tree, reference);
  }
}

TEST_CASE("with a cloud, what it holds is occupied, what rays found free is free, and the rest is unknown") {
  // A wall of the cloud at x = 2; rays from the origin go through it in one place and end elsewhere beyond
  // it.
  const double resolution_m = 0.1;
  const std::uint16_t middle = 1 << 15;
  LabelledCloud cloud;
  for (int y = -5; y < 5; ++y)
    cloud.push_back({.x = 2.05F, .y = 0.1F * static_cast<float>(y) + 0.05F, .z = 0.05F});
  octomap::ColorOcTree model(resolution_m);
  RayMap map(model);
  const std::vector<RayEnd> ends{{{static_cast<std::uint16_t>(middle + 30), middle, middle}, true}};
  for (int frame = 0; frame < 4; ++frame) map.add(cells_of_rays({0.05, 0.05, 0.05}, ends, resolution_m));
  const Parameters parameters{.resolution_m = resolution_m};
  const auto cells = map.cells();
  SemanticTree semantic = build_tree(sort_into_leaves(cloud, resolution_m).points, free_cells(cells, 16),
                                     Occupied::by_cloud, parameters);
  const auto state = [&](double x, double y) {
    const auto* node = semantic.tree->search(x, y, 0.05);
    return node == nullptr ? 'u' : semantic.tree->isNodeOccupied(node) ? 'o' : 'f';
  };
  CHECK(state(1.05, 0.05) == 'f');
  CHECK(state(2.05, 0.05) == 'o');
  CHECK(state(2.55, 0.05) == 'f');
  CHECK(state(3.05, 0.05) == 'u');  // a ray ended there, but the cloud has nothing
  CHECK(state(1.05, 0.35) == 'u');
  CHECK(semantic.leaf_labels.size() == 10);

  SemanticTree by_rays =
      build_tree(sort_into_leaves(cloud, resolution_m).points, cells, Occupied::by_rays, parameters);
  CHECK(by_rays.tree->isNodeOccupied(by_rays.tree->search(3.05, 0.05, 0.05)));
  CHECK_FALSE(by_rays.tree->isNodeOccupied(by_rays.tree->search(2.05, 0.05, 0.05)));
  CHECK(by_rays.tree->isNodeOccupied(by_rays.tree->search(2.05, 0.35, 0.05)));  // no ray said anything
}

TEST_CASE("a coarse tree of rays has the values of the inner nodes of the fine one") {
  const auto sequence = test::synthetic_sequence({.frames = 3, .rate_hz = 5});
  octomap::ColorOcTree reference(0.05);
  RayMap map(reference);
  const auto frames = frames_of(sequence, 0.05, false);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3 origin = sequence.groundtruth[i].world_from_camera.translation;
    insert(reference, origin, frames[i]);
    map.add(cells_of_rays(origin, frames[i], 0.05));
  }
  SemanticTree coarse =
      build_tree({}, map.cells(), Occupied::by_rays, {.resolution_m = 0.05, .max_depth = 14});
  std::size_t compared = 0;
  for (auto leaf = coarse.tree->begin_leafs(); leaf != coarse.tree->end_leafs(); ++leaf) {
    const auto* inner = reference.search(leaf.getKey(), leaf.getDepth());
    REQUIRE(inner != nullptr);
    REQUIRE(inner->getLogOdds() == leaf->getLogOdds());
    ++compared;
  }
  CHECK(compared > 100);
}
