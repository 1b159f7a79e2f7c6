#include <octomap/ColorOcTree.h>

#include <catch2/catch.hpp>

#include "pipeline/artifacts/grid_map.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/octree.hpp"
#include "tests/tools/evaluate-map/small_room.hpp"
#include "tools/evaluate-map/map_evaluation.hpp"

using namespace sediment;
using namespace sediment::tools;
using sediment::test::SmallRoom;

namespace {

octomap::point3d at(const LabelledPoint& p) {
  return {p.x, p.y + 0.001f, p.z};
}

/// A tree of the wall, which is 1 mm behind y = 2 so that it lies inside cells.
std::unique_ptr<octomap::ColorOcTree> wall_tree(const SmallRoom& room) {
  auto tree = std::make_unique<octomap::ColorOcTree>(0.05);
  for (const LabelledPoint& point : room.wall()) tree->updateNode(at(point), true);
  return tree;
}

MapEvaluation evaluate(const SmallRoom& room, octomap::ColorOcTree& tree) {
  std::vector<LeafLabel> labels;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const auto key = leaf.getIndexKey();
    labels.push_back({{key[0], key[1], key[2]}, static_cast<std::uint8_t>(leaf.getDepth()), 62});
  }
  const test::TemporaryFolder folder;
  write_octree(folder.path(), tree, labels, default_labels());
  return evaluate_map({room.open(), MapRules{}}, folder.path(), {});
}

/// The room's floor plan: x -0.95 .. 0.95, y 0 .. 2.1; the wall is the row at y = 2. In the world of the
/// truth.
GridMap plan() {
  GridMap map;
  map.width = 38;
  map.height = 42;
  map.origin_x_m = -0.95;
  map.cells.assign(38 * 42, Cell::free);
  for (int x = 0; x < 38; ++x) {
    map.at(x, 40) = Cell::occupied;
    map.at(x, 41) = Cell::unknown;
  }
  return map;
}

GridScore score_of(const SmallRoom& room, const GridMap& map, const LabelledCloud& floor = {}) {
  const TrueSequence truth = room.open();
  std::vector<Vec3> still;
  for (const LabelledCloud* cloud : {&truth.static_cloud, &floor})
    for (const LabelledPoint& p : *cloud) still.push_back({p.x, p.y + 0.001, p.z});
  return grid_score(map, {}, still, still, FreeSpace(truth, 0.05));
}

}  // namespace

TEST_CASE("a tree of the wall alone is right about what is occupied and says nothing of free space") {
  const SmallRoom room;
  const MapEvaluation e = evaluate(room, *wall_tree(room));
  CHECK(e.kind == "octree");
  CHECK(e.octree->occupied_cells == 38 * 28);
  CHECK(e.octree->occupied_precision == 1.0);
  CHECK(e.octree->occupied_recall == 1.0);
  CHECK_FALSE(e.octree->free_precision);
  CHECK(e.octree->free_recall == 0.0);
  CHECK(e.labels->classes.at(62).iou() == 1);
}

TEST_CASE("pruned leaves count as all the cells they stand for") {
  octomap::ColorOcTree tree(0.05);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z)
        tree.updateNode(octomap::point3d(0.05f * x + 0.02f, 0.05f * y + 0.02f, 0.05f * z + 0.02f), true);
  tree.prune();
  CHECK(tree.getNumLeafNodes() == 1);
  const LabelledCloud cells = occupied_cells(tree, "nowhere");
  REQUIRE(cells.size() == 64);
  VoxelSet seen(0.05);
  for (const LabelledPoint& cell : cells) seen.insert(Vec3{cell.x, cell.y, cell.z});
  CHECK(seen.size() == 64);
  CHECK(seen.contains({0, 0, 0}));
  CHECK(seen.contains({3, 3, 3}));
}

TEST_CASE("free space of a tree is compared with what was seen through") {
  const SmallRoom room;
  auto tree = wall_tree(room);
  // Everything between camera and wall is free in the tree; a slab of it is not.
  for (float x = -0.925f; x < 0.95f; x += 0.05f)
    for (float y = 0.325f; y < 1.9f; y += 0.05f)
      for (float z = 0.325f; z < 1.7f; z += 0.05f) tree->updateNode(octomap::point3d(x, y, z), x > 0);
  const MapEvaluation e = evaluate(room, *tree);
  CHECK(e.octree->free_precision == 1.0);
  CHECK(e.octree->free_recall.value() == Approx(0.5).margin(0.08));
  CHECK(e.octree->occupied_precision.value() < 0.1);
}

TEST_CASE("the true plan of the room is right about its wall and its free space") {
  const SmallRoom room;
  const GridScore score = score_of(room, plan());
  CHECK(score.true_occupied == 38);
  CHECK(score.occupied == 38);
  CHECK(score.occupied_precision == 1.0);
  CHECK(score.occupied_recall == 1.0);
  CHECK(score.free_precision == 1.0);
  CHECK(score.free_precision_strict == 1.0);
  CHECK(score.true_free > 400);
  CHECK_FALSE(score.free_recall);  // no ground was seen
  CHECK(score.free_unobserved.value() ==
        Approx(1 - static_cast<double>(score.true_free) / score.free).epsilon(1e-9));
  CHECK(score.tilt_deg == Approx(0).margin(1e-6));
}

TEST_CASE("ground that was seen is asked to be free") {
  const SmallRoom room;
  LabelledCloud floor;
  for (int x = 0; x < 20; ++x) {
    LabelledPoint point;
    point.x = static_cast<float>(-0.925 + 0.05 * x);
    point.y = 1.525f;
    floor.push_back(point);
  }
  GridMap map = plan();
  CHECK(score_of(room, map, floor).free_recall == 1.0);
  for (int x = 0; x < 5; ++x) map.at(x, 30) = Cell::unknown;
  CHECK(score_of(room, map, floor).free_recall == 0.75);
}

TEST_CASE("a wall that is missing, or two cells off, makes free space wrong; one cell off does not") {
  const SmallRoom room;
  const auto with_wall_at = [](int y) {
    GridMap map = plan();
    for (int x = 0; x < map.width; ++x) {
      map.at(x, 40) = Cell::free;
      if (y >= 0) map.at(x, y) = Cell::occupied;
    }
    return map;
  };
  CHECK(score_of(room, with_wall_at(39)).free_precision == 1.0);
  CHECK(score_of(room, with_wall_at(39)).free_precision_strict.value() < 1);
  CHECK(score_of(room, with_wall_at(39)).occupied_recall == 1.0);
  CHECK(score_of(room, with_wall_at(38)).free_precision.value() < 1);
  CHECK(score_of(room, with_wall_at(38)).occupied_recall == 0.0);
  CHECK(score_of(room, with_wall_at(38)).occupied_precision == 0.0);
  CHECK(score_of(room, with_wall_at(-1)).occupied_recall == 0.0);
}

TEST_CASE("a map of a tilted world with a tilted ground is the same map") {
  const SmallRoom room;
  Pose tilted_from_world = rotation_from({0.35, 0.1, 0});
  tilted_from_world.translation = {1, 2, 3};
  GridMap map = plan();
  map.map_from_world = tilted_from_world.inverse();
  const TrueSequence truth = room.open();
  std::vector<Vec3> still;
  for (const LabelledPoint& p : truth.static_cloud) still.push_back({p.x, p.y + 0.001, p.z});
  const GridScore score = grid_score(map, tilted_from_world.inverse(), still, still, FreeSpace(truth, 0.05));
  // The ground of the map is off by the tilt twice over: truth_from_world and map_from_world are the same
  // here.
  CHECK(score.tilt_deg == Approx(0).margin(1e-6));
  CHECK(score.occupied_recall == 1.0);
  map.map_from_world = {};
  CHECK(grid_score(map, tilted_from_world.inverse(), still, still, FreeSpace(truth, 0.05)).tilt_deg > 15);
}
