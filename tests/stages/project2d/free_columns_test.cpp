#include "stages/project2d/free_columns.hpp"

#include <octomap/ColorOcTree.h>

#include <catch2/catch.hpp>

#include "stages/project2d/grid_projection.hpp"

using namespace sediment;
using namespace sediment::project2d;

namespace {

/// Free air over [0, 2) x [0, 1) up to 1 m, a block of 0.2 m on the ground at its far end.
std::unique_ptr<octomap::ColorOcTree> room() {
  auto tree = std::make_unique<octomap::ColorOcTree>(0.1);
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 10; ++y)
      for (int z = 0; z < 10; ++z) {
        const bool block = x >= 18 && z < 2;
        tree->updateNode(
            octomap::OcTreeKey(static_cast<std::uint16_t>(32768 + x), static_cast<std::uint16_t>(32768 + y),
                               static_cast<std::uint16_t>(32768 + z)),
            block);
      }
  return tree;
}

}  // namespace

TEST_CASE("the free share of a column is that of the heights that the octree knows to be free") {
  const auto tree = room();
  const FreeColumns columns(*tree, Pose{});
  CHECK(columns.free_share(0.55, 0.55, 0, 1) == Approx(1));
  CHECK(columns.free_share(0.55, 0.55, 0, 2) == Approx(0.5));
  CHECK(columns.free_share(1.85, 0.55, 0, 1) == Approx(0.8));
  CHECK(columns.free_share(-0.55, 0.55, 0, 1) == 0);
}

TEST_CASE("the columns stand on a ground that is tilted against the octree") {
  const auto tree = room();
  // z of the map is x of the world.
  const Pose map_from_world{{0, 1, 0, 0, 0, 1, 1, 0, 0}, {0, 0, 0}};
  const FreeColumns columns(*tree, map_from_world);
  CHECK(columns.free_share(0.55, 0.55, 0, 2) == Approx(1));
  CHECK(columns.free_share(0.55, 0.05, 0, 2) == Approx(0.9));
  CHECK(columns.free_share(1.55, 0.55, 0, 2) == 0);
}

TEST_CASE("with rays, air over ground that the cloud does not have is free, and what nobody saw is unknown") {
  const auto tree = room();
  const LabelledCloud cells = occupied_cells(*tree, "no-such-folder");
  CHECK(cells.size() == 2 * 10 * 2);
  GridParameters parameters{.resolution = 0.1, .min_height = 0.1, .max_height = 0.9, .margin = 2.5};
  GridStatistics statistics;
  parameters.empty_cells = EmptyCells::rays;
  const GridMap map = project(cells, Plane{}, parameters, statistics, free_by_rays(tree.get(), parameters));
  const auto cell = [&](double x_m, double y_m) {
    return map.at(static_cast<int>(std::floor((x_m - map.origin_x_m) / map.resolution_m)),
                  static_cast<int>(std::floor((y_m - map.origin_y_m) / map.resolution_m)));
  };
  CHECK(cell(0.55, 0.55) == Cell::free);
  CHECK(cell(1.85, 0.55) == Cell::occupied);
  CHECK(cell(2.55, 0.55) == Cell::unknown);
  CHECK(cell(0.55, 1.55) == Cell::unknown);
  CHECK(statistics.free == 18 * 10);
  CHECK(statistics.occupied == 2 * 10);
}

TEST_CASE("air at the foot of the band is enough if asked for, air above it is not") {
  const auto tree = room();  // free up to 1 m
  GridParameters parameters{.min_height = 0.1, .max_height = 2.9};
  const auto is_free = [&](double from_m, double foot_m) {
    parameters.min_height = from_m;
    parameters.free_foot_m = foot_m;
    return free_by_rays(tree.get(), parameters)(Pose{})(0.55, 0.55);
  };
  CHECK_FALSE(is_free(0.1, 0));  // a third of the band
  CHECK(is_free(0.1, 0.3));
  CHECK_FALSE(is_free(0.9, 0.3));
}

TEST_CASE("an octree without an occupied leaf is refused by name") {
  const octomap::ColorOcTree empty(0.1);
  CHECK_THROWS_WITH(occupied_cells(empty, "some/folder"), Catch::Contains("some/folder"));
}
