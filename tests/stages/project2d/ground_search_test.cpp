#include "stages/project2d/ground_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "stages/project2d/up_hint.hpp"
#include "tests/stages/project2d/test_rooms.hpp"

using namespace sediment;
using namespace sediment::project2d;

namespace {

/// The floor of the test room (z = 0) in the world.
Plane floor_in_world(const Pose& world_from_room) {
  const Vec3 normal = world_from_room.rotate({0, 0, 1});
  return {normal, -dot(normal, world_from_room.translation)};
}

void check_is(const Plane& found, const Plane& truth) {
  CHECK(std::acos(std::min(1.0, dot(found.normal, truth.normal))) * 180 / std::numbers::pi < 0.3);
  CHECK(found.offset_m == Approx(truth.offset_m).margin(0.01));
}

}  // namespace

TEST_CASE("the floor is found in the frame of a first camera, level or looking down") {
  const double pitch_deg = GENERATE(0.0, 20.0, 40.0);
  const double floor_depth_m = GENERATE(4.0, 1.5);
  const Pose world_from_room = test::room_from_test_camera(pitch_deg).inverse();
  const Ground ground = find_ground(test::test_room(floor_depth_m, world_from_room, 1), std::nullopt, {});
  CHECK(ground.floor);
  check_is(ground.plane, floor_in_world(world_from_room));
}

TEST_CASE("the floor is found in a map frame, where larger walls stand too") {
  const double yaw = GENERATE(0.0, 1.0, 3.0);
  const Pose world_from_room = Pose{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {3, -5, 0.02}} * rotation_from({0, 0, yaw});
  const Ground ground = find_ground(test::test_room(1.0, world_from_room, 2), std::nullopt, {});
  CHECK(ground.floor);
  check_is(ground.plane, floor_in_world(world_from_room));
}

TEST_CASE("any orientation of the world will do with a trajectory, or with the upward direction") {
  const Pose world_from_room = rotation_from({2.0, -0.7, 1.1});
  const LabelledCloud cloud = test::test_room(2.5, world_from_room, 3);
  Trajectory trajectory;
  for (const double pitch_deg : {0.0, 30.0, -10.0})
    trajectory.push_back({"0", 0, world_from_room * test::room_from_test_camera(pitch_deg)});
  for (const UpHint& hint : {up_from_trajectory(trajectory),
                             UpHint{world_from_room.rotate(normalized({0.1, 0.2, 1})), 20, "given"}}) {
    const Ground ground = find_ground(cloud, hint, {});
    CHECK(ground.floor);
    check_is(ground.plane, floor_in_world(world_from_room));
  }
}

TEST_CASE("a few reflections below the floor do not hide it") {
  LabelledCloud cloud = test::test_room(4, {}, 4);
  for (int i = 0; i < 100; ++i) {
    LabelledPoint p;
    p.x = 0.05f * static_cast<float>(i), p.y = 1, p.z = -0.8f;
    cloud.push_back(p);
  }
  const Ground ground = find_ground(cloud, std::nullopt, {});
  CHECK(ground.floor);
  CHECK(ground.below > 0);
  check_is(ground.plane, {{0, 0, 1}, 0});
}

TEST_CASE("without a floor the desk top is the ground, and is said to be no floor") {
  const Pose world_from_room = test::room_from_test_camera(35).inverse();
  const Ground ground = find_ground(test::test_desk(world_from_room, 5), std::nullopt, {});
  CHECK_FALSE(ground.floor);
  CHECK_THAT(ground.source, Catch::Contains("no floor is seen"));
  const Plane floor = floor_in_world(world_from_room);
  check_is(ground.plane, {floor.normal, floor.offset_m - 0.7});
}

TEST_CASE("where there is no ground the error says the way out") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  LabelledCloud line(100, LabelledPoint{});
  for (std::size_t i = 0; i < line.size(); ++i) line[i].x = 0.1f * static_cast<float>(i);
  for (const LabelledCloud& cloud : {LabelledCloud{}, LabelledCloud(1), LabelledCloud(1000, LabelledPoint{}),
                                     line, LabelledCloud(9, LabelledPoint{nan, 0, 0, 0, 0, 0, 0, 0, 0})})
    CHECK_THROWS_WITH(find_ground(cloud, std::nullopt, {}),
                      Catch::Contains("no ground found") && Catch::Contains("nx ny nz d"));
}

TEST_CASE("planes and directions by hand are read, and normalised") {
  const Plane plane = parse_plane(" 0 0 2 -1 ");
  CHECK(plane.normal == Vec3{0, 0, 1});
  CHECK(plane.offset_m == -0.5);
  CHECK(parse_up("0 -3 0").up == Vec3{0, -1, 0});
  for (const char* wrong : {"", "0 0 1", "0 0 0 1", "0 0 1 1 1", "a b c d", "0 0 nan 1", "0 0 1 inf"})
    CHECK_THROWS_WITH(parse_plane(wrong), Catch::Contains("nx ny nz d"));
  for (const char* wrong : {"", "0 0", "0 0 0", "1 2 3 4", "up"})
    CHECK_THROWS_WITH(parse_up(wrong), Catch::Contains("x y z"));
  CHECK_THROWS_WITH(up_from_trajectory({}), Catch::Contains("says nothing"));
}
