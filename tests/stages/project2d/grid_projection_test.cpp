#include "stages/project2d/grid_projection.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/stages/project2d/map_server_loader.hpp"
#include "tests/stages/project2d/test_rooms.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::project2d;

namespace {

const Plane kLevel{{0, 0, 1}, 0};

LabelledPoint point(float x, float y, float z) {
  LabelledPoint p;
  p.x = x, p.y = y, p.z = z;
  return p;
}

GridMap projected(const LabelledCloud& cloud, const Plane& ground, const GridParameters& parameters) {
  GridStatistics statistics;
  return project(cloud, ground, parameters, statistics);
}

Cell cell_at(const GridMap& map, double x_m, double y_m) {
  return map.at(static_cast<int>((x_m - map.origin_x_m) / map.resolution_m),
                static_cast<int>((y_m - map.origin_y_m) / map.resolution_m));
}

}  // namespace

TEST_CASE("a cell is occupied if a point of the band stands on it, else free") {
  GridParameters parameters;
  parameters.resolution = 0.1;
  GridStatistics statistics;
  const LabelledCloud cloud{point(0.05f, 0.05f, 0.5f), point(1.05f, 0.05f, 0.05f), point(0.05f, 2.05f, 1.7f),
                            point(1.05f, 2.05f, 1.9f)};
  const GridMap map = project(cloud, kLevel, parameters, statistics);
  CHECK(cell_at(map, 0.05, 0.05) == Cell::occupied);  // in the band
  CHECK(cell_at(map, 1.05, 0.05) == Cell::free);      // ground
  CHECK(cell_at(map, 0.05, 2.05) == Cell::occupied);
  CHECK(cell_at(map, 1.05, 2.05) == Cell::free);  // overhead
  CHECK(statistics.occupied == 2);
  CHECK(statistics.points_in_band == 2);
  CHECK(statistics.points_below == 1);
  CHECK(statistics.points_above == 1);
  CHECK(statistics.occupied + statistics.free == map.cells.size());
}

TEST_CASE("cells can stay unknown where no ground was seen") {
  GridParameters parameters;
  parameters.empty_cells = EmptyCells::seen;
  const GridMap map =
      projected({point(0, 0, 0.5f), point(1, 0, 0.02f), point(1, 1, -0.5f)}, kLevel, parameters);
  CHECK(cell_at(map, 0.01, 0.01) == Cell::occupied);
  CHECK(cell_at(map, 1.01, 0.01) == Cell::free);
  CHECK(cell_at(map, 1.01, 1.01) == Cell::unknown);  // below the ground: a reflection
  CHECK(cell_at(map, 0.5, 0.5) == Cell::unknown);
}

TEST_CASE("the transform lays the ground into z = 0 with z up, and is a rotation") {
  for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{-0.3, 0.5, -0.2}}) {
    const Plane plane{normalized(normal), 0.8};
    const Pose map = map_from_world(plane);
    const Vec3 foot = -0.8 * plane.normal;
    CHECK(norm(map * foot) < 1e-12);
    CHECK((map * (foot + 2 * plane.normal)).z == Approx(2));
    const Pose identity = map * map.inverse();
    CHECK(rotation_angle(identity) < 1e-6);
    const auto& r = map.rotation;
    CHECK(dot(cross({r[0], r[1], r[2]}, {r[3], r[4], r[5]}), {r[6], r[7], r[8]}) == Approx(1));
  }
  CHECK(map_from_world({{0, 0, 1}, 0}) == Pose{});
}

TEST_CASE("a tilted world gives the same grid") {
  GridParameters parameters;
  const Pose tilt = rotation_from({0.35, 0, 0});  // 20 degrees about x keeps the map's x axis
  const GridMap level = projected(test::test_room(4, {}, 1), kLevel, parameters);
  const GridMap tilted = projected(test::test_room(4, tilt, 1), {tilt.rotate({0, 0, 1}), 0}, parameters);
  REQUIRE(tilted.width == level.width);
  REQUIRE(tilted.height == level.height);
  int different = 0;
  for (std::size_t i = 0; i < level.cells.size(); ++i) different += level.cells[i] == tilted.cells[i] ? 0 : 1;
  CHECK(different <= 2);  // rounding at the borders of cells
}

TEST_CASE("map_server and nav2 load the grid cell by cell as it was meant") {
  GridParameters parameters;
  parameters.empty_cells = EmptyCells::seen;
  const GridMap map = projected(test::test_room(2, {}, 2), kLevel, parameters);
  const test::TemporaryFolder folder;
  write_grid_map(folder.path(), map);
  const test::Thresholds ros1{0.65, 0.196};  // the defaults of ROS 1's examples
  for (const test::Thresholds* thresholds : {static_cast<const test::Thresholds*>(nullptr), &ros1}) {
    const test::OccupancyGrid loaded = test::load_as_map_server(folder / "map.yaml", thresholds);
    REQUIRE(loaded.width == map.width);
    REQUIRE(loaded.height == map.height);
    CHECK(loaded.resolution_m == map.resolution_m);
    CHECK(loaded.origin_x_m == Approx(map.origin_x_m));
    CHECK(loaded.origin_y_m == Approx(map.origin_y_m));
    int wrong = 0;
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        wrong += loaded.at(x, y) == (map.at(x, y) == Cell::occupied ? 100
                                     : map.at(x, y) == Cell::free   ? 0
                                                                    : -1)
                     ? 0
                     : 1;
    CHECK(wrong == 0);
  }
}

TEST_CASE("the walls and the box of a room are where they stand") {
  GridParameters parameters;
  const GridMap map = projected(test::test_room(4, {}, 3), kLevel, parameters);
  CHECK(cell_at(map, 3.0, 4.01) == Cell::occupied);  // wall
  CHECK(cell_at(map, 2.3, 2.3) == Cell::occupied);   // box
  CHECK(cell_at(map, 1.0, 1.0) == Cell::free);
  CHECK(cell_at(map, 4.0, 2.0) == Cell::free);
}

TEST_CASE("nothing to project and grids without end are errors") {
  const float inf = std::numeric_limits<float>::infinity();
  CHECK_THROWS_WITH(projected({}, kLevel, {}), Catch::Contains("nothing to project"));
  CHECK_THROWS_WITH(projected({point(inf, 0, 0), point(0, 0, 5)}, kLevel, {}),
                    Catch::Contains("nothing to project"));
  CHECK_THROWS_WITH(projected({point(0, 0, 0.5f), point(1e6f, 1e6f, 0.5f)}, kLevel, {}),
                    Catch::Contains("raise `resolution`"));
  CHECK(projected({point(1e6f, -1e6f, 0.5f)}, kLevel, {}).cells.size() < 1000);
}
