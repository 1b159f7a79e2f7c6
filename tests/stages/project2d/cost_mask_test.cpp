#include "stages/project2d/cost_mask.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "pipeline/artifacts/label_file.hpp"
#include "tests/stages/project2d/map_server_loader.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::project2d;

namespace {

LabelledPoint at(float x, float y, float z, std::uint32_t label) {
  return {.x = x, .y = y, .z = z, .label = label};
}

GridMap four_by_three() {
  GridMap map;
  map.width = 4, map.height = 3, map.resolution_m = 0.5;
  map.origin_x_m = -1, map.origin_y_m = 2;
  map.cells.assign(12, Cell::free);
  return map;
}

ClassCosts costs_from(const std::string& yaml) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "costs.yaml") << yaml;
  return read_class_costs(folder / "costs.yaml");
}

}  // namespace

TEST_CASE(
    "each cell of the cost mask has the highest cost of the classes in it, and nav2 and map_server load it") {
  const test::TemporaryFolder folder;
  const GridMap map = four_by_three();
  const ClassCosts costs{{{"chair", 60}, {"potted plant", 100}}, 5, 0};
  const LabelledCloud cloud{at(-0.9F, 2.1F, 0.5F, 56),
                            at(-0.9F, 2.1F, 0.2F, 62),       // chair and tv
                            at(0.9F, 3.4F, 0.5F, 58),        // plant
                            at(0.1F, 2.6F, 0, kUnlabelled),  // ground
                            at(0.1F, 3.4F, 2.5F, 58),        // above the robot
                            at(9, 9, 0, 56),
                            at(NAN, 2.1F, 0, 56)};
  const auto mask = cost_mask(map, cloud, default_labels(), costs, 1.8, 1);
  write_cost_mask(folder.path(), map, mask);
  const test::OccupancyGrid loaded = test::load_as_map_server(folder / "costs.yaml");
  CHECK(loaded.at(0, 0) == 60);
  CHECK(loaded.at(3, 2) == 100);
  CHECK(loaded.at(2, 1) == 5);
  CHECK(loaded.at(2, 2) == -1);
  CHECK(loaded.at(1, 0) == -1);
  CHECK(loaded.origin_x_m == -1);
}

TEST_CASE("a cost reaches as far as it is told, and the higher one wins") {
  const GridMap map = four_by_three();
  const ClassCosts costs{{{"chair", 60}, {"tv", 20}}, 0, 1};
  const LabelledCloud cloud{at(-0.9F, 2.1F, 0.5F, 56), at(0.1F, 2.1F, 0.5F, 62)};
  const auto mask = cost_mask(map, cloud, default_labels(), costs, 1.8, 1);
  CHECK(mask[0] == 60);
  CHECK(mask[1] == 60);  // between both
  CHECK(mask[2] == 20);
  CHECK(mask[3] == 20);
  CHECK(mask[4] == 60);
  CHECK(mask[8] == kNoCost);
}

TEST_CASE("fewer points than asked for cost nothing") {
  const auto mask =
      cost_mask(four_by_three(), {at(-0.9F, 2.1F, 0.5F, 56)}, default_labels(), {{{"chair", 60}}}, 1.8, 2);
  CHECK(mask[0] == kNoCost);
}

TEST_CASE("costs are read strictly") {
  const ClassCosts costs = costs_from("costs: {chair: 60, person: 100}\ndefault: 3\nreach_cells: 2\n");
  CHECK(costs.of_class.at("chair") == 60);
  CHECK(costs.otherwise == 3);
  CHECK(costs.reach_cells == 2);
  CHECK_THROWS_WITH(costs_from("costs: {chair: 101}\n"), Catch::Contains("chair") && Catch::Contains(":1"));
  CHECK_THROWS_WITH(costs_from("costs: {chair: much}\n"), Catch::Contains("chair"));
  CHECK_THROWS_WITH(costs_from("cost: {}\n"), Catch::Contains("cost"));
  CHECK_THROWS(costs_from("default: 3\n"));
  CHECK_THROWS(costs_from("costs: {}\nreach_cells: -1\n"));
}
