#include <catch2/catch.hpp>

#include "stages/track/bundle_adjustment.hpp"
#include "stages/track/registration.hpp"
#include "tests/stages/track/scattered_points.hpp"

using namespace sediment;
using namespace sediment::track;
using namespace sediment::track::test;

namespace {

double distance(const Pose& a, const Pose& b) {
  return norm(a.translation - b.translation) + rotation_angle(a * b.inverse());
}

const Pose kTruth = [] {
  Pose pose = rotation_from({0.1, -0.2, 0.3});
  pose.translation = {0.4, -0.1, 0.2};
  return pose;
}();

}  // namespace

TEST_CASE("the derivative of the residual equals its numeric derivative") {
  const Pinhole pinhole = test_pinhole();
  Measurement measurement;
  measurement.u_px = 300;
  measurement.v_px = 200;
  measurement.inverse_depth = 0.45;
  measurement.pixel_weight = 1.3;
  measurement.depth_weight = 500;
  const Vec3 p{0.3, -0.4, 2.1};
  const auto analytic = residual_by_point(measurement, pinhole, p);
  for (int axis = 0; axis < 3; ++axis) {
    const double h = 1e-6;
    Vec3 ahead = p, behind = p;
    (&ahead.x)[axis] += h;
    (&behind.x)[axis] -= h;
    const auto a = residual_of(measurement, pinhole, ahead), b = residual_of(measurement, pinhole, behind);
    for (int row = 0; row < 3; ++row)
      CHECK(analytic[row * 3 + axis] == Approx((a[row] - b[row]) / (2 * h)).epsilon(1e-6).margin(1e-5));
  }
}

TEST_CASE("a measurement without depth has no depth residual and no derivative of it") {
  Measurement measurement;
  measurement.depth_weight = 500;
  CHECK(residual_of(measurement, test_pinhole(), {0, 0, 2})[2] == 0);
  CHECK(residual_by_point(measurement, test_pinhole(), {0, 0, 2})[8] == 0);
}

TEST_CASE("a pose is found to numeric precision from exact correspondences") {
  const auto correspondences = observe(scattered_points(60), kTruth, test_pinhole());
  const auto estimate = estimate_pose(correspondences, test_pinhole(), Pose{});
  CHECK(estimate.inliers == 60);
  CHECK(distance(estimate.camera_from_world, kTruth) < 1e-8);
}

TEST_CASE("a pose is found although a third of the correspondences is wrong") {
  auto correspondences = observe(scattered_points(90), kTruth, test_pinhole());
  for (std::size_t i = 0; i < correspondences.size(); i += 3) correspondences[i].measurement.u_px += 40;
  Pose start = kTruth;
  start.translation.x += 0.05;
  const auto estimate = estimate_pose(correspondences, test_pinhole(), start);
  CHECK(estimate.inliers == 60);
  CHECK(distance(estimate.camera_from_world, kTruth) < 1e-6);
}

TEST_CASE("a pose is found without a guess although more than half of the correspondences is wrong") {
  auto correspondences = observe(scattered_points(100), kTruth, test_pinhole());
  for (std::size_t i = 0; i < 60; ++i) correspondences[i].point = correspondences[99 - i % 40].point;
  const auto estimate = find_pose(correspondences, test_pinhole(), 20);
  REQUIRE(estimate);
  CHECK(estimate->inliers == 40);
  CHECK(distance(estimate->camera_from_world, kTruth) < 1e-6);
}

TEST_CASE("no pose is made up from correspondences that do not agree") {
  auto correspondences = observe(scattered_points(100), kTruth, test_pinhole());
  const auto points = scattered_points(100);
  for (std::size_t i = 0; i < 100; ++i) correspondences[i].point = points[(i * 37 + 11) % 100];
  CHECK_FALSE(find_pose(correspondences, test_pinhole(), 15));
  CHECK_FALSE(find_pose({}, test_pinhole(), 1));
}

TEST_CASE("a rigid alignment takes points onto their images") {
  const auto points = scattered_points(5);
  std::vector<Vec3> images;
  for (const Vec3& point : points) images.push_back(kTruth * point);
  CHECK(distance(rigid_alignment(points, images), kTruth) < 1e-12);
}

TEST_CASE("bundle adjustment restores disturbed poses and points to the truth") {
  Bundle bundle;
  const auto truth = scattered_points(80);
  std::vector<Pose> poses;
  for (int i = 0; i < 4; ++i) {
    Pose pose = rotation_from({0.02 * i, -0.05 * i, 0.03 * i});
    pose.translation = {0.1 * i, 0.02 * i, -0.05 * i};
    poses.push_back(pose);
    const auto seen = observe(truth, pose, test_pinhole());
    for (int j = 0; j < 80; ++j) bundle.observations.push_back({i, j, seen[j].measurement});
    bundle.cameras.push_back(
        {i == 0 ? pose : updated(pose, {0.01, -0.02, 0.01}, {0.03, 0.02, -0.04}), i == 0});
  }
  bundle.points = truth;
  for (std::size_t i = 0; i < bundle.points.size(); ++i) bundle.points[i].z += i % 2 ? 0.05 : -0.03;
  adjust(bundle, test_pinhole(), {30, true});
  for (int i = 0; i < 4; ++i) CHECK(distance(bundle.cameras[i].camera_from_world, poses[i]) < 1e-4);
  for (int j = 0; j < 80; ++j) CHECK(norm(bundle.points[j] - truth[j]) < 1e-3);
  CHECK(distance(bundle.cameras[0].camera_from_world, poses[0]) == 0);
}
