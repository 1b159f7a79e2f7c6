#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "stages/project2d/grid_projection.hpp"
#include "stages/project2d/ground_search.hpp"
#include "tests/stages/project2d/test_rooms.hpp"

using namespace sediment;
using namespace sediment::project2d;

namespace {

GridMap map_of(const LabelledCloud& cloud, const std::optional<UpHint>& hint) {
  GridParameters parameters;
  parameters.empty_cells = EmptyCells::seen;
  GridStatistics statistics;
  return project(cloud, find_ground(cloud, hint, {}).plane, parameters, statistics);
}

/// Share of the known cells of `map` that `other` knows alike, within one cell: their grids lie differently.
double agreement(const GridMap& map, const GridMap& other, const Pose& other_world_from_world) {
  const Pose other_from_map = other.map_from_world * other_world_from_world * map.map_from_world.inverse();
  std::size_t known = 0, alike = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      if (map.at(x, y) == Cell::unknown) continue;
      const Vec3 p = other_from_map * Vec3{map.origin_x_m + (x + 0.5) * map.resolution_m,
                                           map.origin_y_m + (y + 0.5) * map.resolution_m, 0};
      const int ox = static_cast<int>(std::floor((p.x - other.origin_x_m) / other.resolution_m));
      const int oy = static_cast<int>(std::floor((p.y - other.origin_y_m) / other.resolution_m));
      bool found = false;
      for (int ny = oy - 1; ny <= oy + 1; ++ny)
        for (int nx = ox - 1; nx <= ox + 1; ++nx)
          if (nx >= 0 && ny >= 0 && nx < other.width && ny < other.height)
            found = found || other.at(nx, ny) == map.at(x, y);
      ++known;
      alike += found ? 1 : 0;
    }
  return static_cast<double>(alike) / static_cast<double>(known);
}

}  // namespace

TEST_CASE("a world tilted by 20 degrees about any horizontal axis, up unknown, gives the same map") {
  const double about_x = GENERATE(0.0, 1.0, -0.7), about_y = std::sqrt(1 - about_x * about_x);
  const double angle = GENERATE(-20, 20) * std::numbers::pi / 180;
  // The world of a first camera, then the same one held 20 degrees askew.
  const Pose world_from_room = test::room_from_test_camera(25).inverse();
  const Pose tilt = rotation_from({about_x * angle, 0, about_y * angle});
  const GridMap level = map_of(test::test_room(4, world_from_room, 3), std::nullopt);
  const GridMap tilted = map_of(test::test_room(4, tilt * world_from_room, 3), std::nullopt);
  CHECK(agreement(level, tilted, tilt) > 0.99);
  CHECK(agreement(tilted, level, tilt.inverse()) > 0.99);
}

TEST_CASE("a map frame tilted by 20 degrees gives the same map when up is known roughly") {
  const Pose tilt = rotation_from({20 * std::numbers::pi / 180, 0, 0});
  const Vec3 up = tilt.rotate({0, 0, 1});
  const Vec3 roughly = rotation_from({0, 10 * std::numbers::pi / 180, 0}).rotate(up);
  const GridMap level = map_of(test::test_room(4, {}, 3), std::nullopt);
  const GridMap tilted = map_of(test::test_room(4, tilt, 3), UpHint{roughly, 20, "given"});
  CHECK(agreement(level, tilted, tilt) > 0.99);
}
