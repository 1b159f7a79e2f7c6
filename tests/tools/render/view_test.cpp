#include "tools/render/view.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::render;

namespace {

std::vector<Vec3> corners(double x, double y, double z) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0});
  return points;
}

}  // namespace

TEST_CASE("a top view has x to the right and y up, to scale") {
  ViewOptions options;
  options.direction = Direction::top;
  options.size = {400, 200};
  const View view = fit_view(corners(4, 2, 1), Pose{}, options);
  const auto origin = view.project({0, 0, 0}), x = view.project({1, 0, 0}), y = view.project({0, 1, 0}),
             up = view.project({0, 0, 1});
  CHECK(x->u - origin->u == Approx(view.scale));
  CHECK(x->v == Approx(origin->v));
  CHECK(origin->v - y->v == Approx(view.scale));
  CHECK(y->u == Approx(origin->u));
  CHECK(up->depth_m < origin->depth_m);
  CHECK(view.scale == Approx(0.92 * 100));
}

TEST_CASE("an oblique view shows all corners, with the sky at the top") {
  for (const double azimuth_deg : {0.0, 100.0, 250.0}) {
    ViewOptions options;
    options.azimuth_deg = azimuth_deg;
    const auto points = corners(6, 4, 2.5);
    const View view = fit_view(points, Pose{}, options);
    for (const Vec3 point : points) {
      const auto at = view.project(point);
      REQUIRE(at);
      CHECK((at->u >= 0 && at->u <= 1280 && at->v >= 0 && at->v <= 960));
    }
    CHECK(view.project({3, 2, 2.5})->v < view.project({3, 2, 0})->v);
  }
}

TEST_CASE("a chosen pose is that of a pinhole camera") {
  ViewOptions options;
  options.direction = Direction::pose;
  options.size = {640, 480};
  options.field_of_view_deg = 90;
  options.world_from_camera = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, -2}};
  const View view = fit_view({}, Pose{}, options);
  const auto at = view.project({1, 0.5, 2});  // 4 m ahead, focal length 320 pixels
  CHECK(at->u == Approx(320 + 80));
  CHECK(at->v == Approx(240 + 40));
  CHECK(at->depth_m == Approx(4));
  CHECK_FALSE(view.project({0, 0, -3}));
}

TEST_CASE("up comes from ground.json, from a direction, or is that of a first camera") {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "ground.json")
      << R"({"map_from_world": [[1,0,0,0],[0,0,1,0],[0,-1,0,1.5],[0,0,0,1]]})";
  CHECK((map_from_world(folder.path().string(), "") * Vec3{0, 1.5, 0}).z == Approx(0));
  CHECK((map_from_world("", "0 0 2") * Vec3{0, 0, 1}).z == Approx(1));
  CHECK((map_from_world("", "") * Vec3{0, -1, 0}).z == Approx(1));
  CHECK_THROWS_WITH(map_from_world("", "0 0"), Catch::Contains("x y z"));
  CHECK_THROWS_WITH(map_from_world((folder / "absent.json").string(), ""), Catch::Contains("absent.json"));
}
