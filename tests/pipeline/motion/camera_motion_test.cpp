#include "pipeline/motion/camera_motion.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace sediment;

namespace {

constexpr double kFocal_px = 525;

/// Points of a room seen by a camera that moves by `to_from`; a share of them moves on its own by 10 cm.
std::vector<SeenPoint> seen_points(const Pose& to_from, double moving_share, double noise_px,
                                   int count = 2000) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::normal_distribution<double> noise(0, noise_px / kFocal_px);
  std::vector<SeenPoint> points;
  for (int i = 0; i < count; ++i) {
    const double z = 2.5 + 1.5 * unit(random);
    const Vec3 from{0.6 * z * unit(random), 0.45 * z * unit(random), z};
    Vec3 to = to_from * from;
    if (i < moving_share * count) to = to + Vec3{0.1, 0.02, 0};
    points.push_back({from, {to.x / to.z + noise(random), to.y / to.z + noise(random)}});
  }
  return points;
}

Pose some_motion() {
  Pose pose = rotation_from({0.01, -0.03, 0.02});
  pose.translation = {0.03, -0.01, 0.02};
  return pose;
}

}  // namespace

TEST_CASE("the motion of the camera is found exactly from exact points") {
  const auto motion = camera_motion(seen_points(some_motion(), 0, 0), kFocal_px);
  REQUIRE(motion);
  CHECK(norm(motion->to_from.translation - some_motion().translation) < 1e-9);
  CHECK(rotation_angle(motion->to_from.inverse() * some_motion()) < 1e-7);
  CHECK(motion->median_error_px < 1e-6);
  CHECK(motion->inlier_share == 1);
}

TEST_CASE("a third of the points that move on their own has no say") {
  const auto motion = camera_motion(seen_points(some_motion(), 0.33, 0.3), kFocal_px);
  REQUIRE(motion);
  CHECK(norm(motion->to_from.translation - some_motion().translation) < 1e-3);
  CHECK(motion->median_error_px < 1);
  CHECK(motion->inlier_share == Approx(0.67).margin(0.05));
}

TEST_CASE("a camera at rest is found at rest") {
  const auto motion = camera_motion(seen_points({}, 0.2, 0.2), kFocal_px);
  REQUIRE(motion);
  CHECK(norm(motion->to_from.translation) < 1e-3);
}

TEST_CASE("too few points, or points that do not agree, give no motion") {
  CHECK_FALSE(camera_motion({}, kFocal_px));
  CHECK_FALSE(camera_motion(seen_points({}, 0, 0, 29), kFocal_px));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<SeenPoint> chaos;
  for (int i = 0; i < 500; ++i)
    chaos.push_back({{unit(random), unit(random), i % 2 ? 1.0 : 1e-3}, {unit(random), unit(random)}});
  const auto motion = camera_motion(chaos, kFocal_px);
  CHECK((!motion || motion->median_error_px > 50));
}
