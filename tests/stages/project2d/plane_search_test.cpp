#include "stages/project2d/plane_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/stages/project2d/test_rooms.hpp"

using namespace sediment;
using namespace sediment::project2d;

namespace {

Surface surface_of(const LabelledCloud& cloud) {
  std::vector<Vec3> points;
  for (const LabelledPoint& p : cloud) points.push_back({p.x, p.y, p.z});
  return sample_surface(points, 0.03);
}

}  // namespace

TEST_CASE("the planes of a room are found, largest first, each within a tenth of a degree") {
  const Pose world_from_room = rotation_from({0.4, 0.3, -0.2});
  const Surface surface = surface_of(test::test_room(4, world_from_room, 1));
  const auto planes = find_planes(surface, {0, 0, 1}, 90, 0.03, 0.1);
  REQUIRE(planes.size() == 5);  // floor, two walls, top and side of the box
  const Vec3 axes[] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  for (int i = 0; i < 3; ++i) {
    const Vec3 truth = world_from_room.rotate(axes[i]);
    CHECK(std::abs(dot(planes[i].plane.normal, truth)) > std::cos(0.1 * 3.14159 / 180));
    CHECK(planes[i].rms_m == Approx(0.005).margin(0.003));
  }
  CHECK(Surface::area_m2(planes[0].samples) == Approx(20).epsilon(0.25));
  CHECK(Surface::area_m2(planes[1].samples) == Approx(12.5).epsilon(0.25));
}

TEST_CASE("planes outside the cone are left out") {
  const Surface surface = surface_of(test::test_room(4, {}, 2));
  const auto planes = find_planes(surface, {0, 0, 1}, 30, 0.03, 0.25);
  REQUIRE(planes.size() == 2);  // floor and top of the box
  for (const SurfacePlane& found : planes) CHECK(std::abs(found.plane.normal.z) > 0.999);
}

TEST_CASE("a plane that holds a tenth of a noisy cloud is found") {
  LabelledCloud cloud;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> along(-2, 2);
  for (int i = 0; i < 60000; ++i) {
    LabelledPoint p;
    p.x = along(random), p.y = along(random), p.z = i % 10 == 0 ? 0.3f * p.x : along(random);
    cloud.push_back(p);
  }
  for (int i = 0; i < 10000; ++i) {
    LabelledPoint p;
    p.x = along(random), p.y = along(random), p.z = 2.5f;
    cloud.push_back(p);
  }
  const auto planes = find_planes(surface_of(cloud), {0, 0, 1}, 45, 0.03, 1.0);
  REQUIRE(!planes.empty());
  CHECK(std::abs(planes[0].plane.normal.z) > 0.9999);
  CHECK(std::abs(planes[0].plane.offset_m) == Approx(2.5).margin(0.01));
}

TEST_CASE("sparse clouds get larger patches") {
  LabelledCloud cloud;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y) {
      LabelledPoint p;
      p.x = 0.2f * static_cast<float>(x), p.y = 0.2f * static_cast<float>(y), p.z = 1;
      cloud.push_back(p);
    }
  const auto planes = find_planes(surface_of(cloud), {0, 0, 1}, 20, 0.03, 0.25);
  REQUIRE(planes.size() == 1);
  CHECK(std::abs(planes[0].plane.offset_m) == Approx(1));
}

TEST_CASE("points without a plane have none") {
  LabelledCloud line(100, LabelledPoint{});
  for (std::size_t i = 0; i < line.size(); ++i) line[i].x = 0.02f * static_cast<float>(i);
  for (const LabelledCloud& cloud : {LabelledCloud{}, LabelledCloud(100, LabelledPoint{}), line})
    CHECK(find_planes(surface_of(cloud), {0, 0, 1}, 90, 0.03, 0.01).empty());
}
