#include "pipeline/scene/pose.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <numbers>

using namespace sediment;

namespace {

constexpr double kPi = std::numbers::pi;

Pose some_pose(double angle_rad, Vec3 axis, Vec3 translation) {
  Pose pose = rotation_from(angle_rad * normalized(axis));
  pose.translation = translation;
  return pose;
}

double difference(const Pose& a, const Pose& b) {
  double largest = norm(a.translation - b.translation);
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a.rotation[i] - b.rotation[i]));
  return largest;
}

}  // namespace

TEST_CASE("a quarter turn about z takes x to y") {
  const Pose turn = rotation_from({0, 0, kPi / 2});
  CHECK(norm(turn * Vec3{1, 0, 0} - Vec3{0, 1, 0}) < 1e-15);
  const Pose same = pose_from({0, 0, std::sqrt(0.5), std::sqrt(0.5)}, {});
  CHECK(difference(turn, same) < 1e-15);
}

TEST_CASE("composition is one transform after the other, and the inverse undoes it") {
  const Pose world_from_camera = some_pose(1.1, {1, -2, 0.5}, {3, 2, 1});
  const Pose camera_from_object = some_pose(-2.7, {0, 1, 3}, {-1, 0.5, 7});
  const Vec3 point{0.3, -4, 2};
  CHECK(norm((world_from_camera * camera_from_object) * point -
             world_from_camera * (camera_from_object * point)) < 1e-14);
  CHECK(difference(world_from_camera.inverse() * world_from_camera, Pose{}) < 1e-15);
}

TEST_CASE("quaternions go to rotations and back for every angle, half turns included") {
  for (double angle_rad = 0; angle_rad <= kPi; angle_rad += kPi / 16) {
    const Pose pose = some_pose(angle_rad, {0.2, -1, 0.7}, {1, 2, 3});
    const Quaternion q = quaternion_of(pose);
    CHECK(q.w >= 0);
    CHECK(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w == Approx(1).epsilon(1e-14));
    CHECK(difference(pose_from(q, pose.translation), pose) < 1e-14);
    CHECK(rotation_angle(pose) == Approx(angle_rad).margin(1e-7));
  }
}

TEST_CASE("a quaternion is normalised, and one without direction is refused") {
  CHECK(difference(pose_from({0, 0, 0, 5}, {1, 2, 3}), pose_from({}, {1, 2, 3})) == 0);
  CHECK_THROWS_AS(pose_from({0, 0, 0, 0}, {}), std::invalid_argument);
  CHECK_THROWS_AS(pose_from({0, std::numeric_limits<double>::quiet_NaN(), 0, 1}, {}), std::invalid_argument);
}

TEST_CASE("interpolation moves on a line and turns at a constant rate") {
  const Pose from = some_pose(0.2, {0, 0, 1}, {0, 0, 0}), to = some_pose(1.0, {0, 0, 1}, {4, 0, -2});
  const Pose quarter = interpolate(from, to, 0.25);
  CHECK(difference(quarter, some_pose(0.4, {0, 0, 1}, {1, 0, -0.5})) < 1e-14);
  CHECK(difference(interpolate(from, to, 0), from) < 1e-15);
  CHECK(difference(interpolate(from, to, 1), to) < 1e-15);
}
