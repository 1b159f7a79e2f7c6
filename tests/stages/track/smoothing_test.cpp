#include "stages/track/smoothing.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/stages/track/scattered_points.hpp"

using namespace sediment;
using namespace sediment::track;

namespace {

constexpr double kNoise_m = 0.003, kNoise_rad = 0.002;

/// A hand that sways at 30 Hz, `frames` long.
std::vector<Pose> swaying(int frames) {
  std::vector<Pose> poses;
  for (int i = 0; i < frames; ++i) {
    const double t = i / 30.0;
    Pose pose = rotation_from({0.2 * std::sin(1.3 * t), 0.5 * std::sin(0.7 * t), 0.1 * std::cos(2 * t)});
    pose.translation = {0.3 * std::sin(0.9 * t), 0.1 * std::cos(1.7 * t), 0.05 * t};
    poses.push_back(pose);
  }
  return poses;
}

struct Noise {
  std::mt19937 random{7};
  std::normal_distribution<double> normal;
  Vec3 next(double deviation) {
    const double x = normal(random), y = normal(random), z = normal(random);
    return {deviation * x, deviation * y, deviation * z};
  }
};

std::vector<MeasuredPose> measured(const std::vector<Pose>& truth, double scale) {
  Noise noise;
  std::vector<MeasuredPose> poses;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Pose pose = truth[i] * rotation_from(noise.next(scale * kNoise_rad));
    pose.translation = truth[i].translation + noise.next(scale * kNoise_m);
    const double known = std::max(scale, 0.1);
    poses.push_back({static_cast<double>(i) / 30, pose, known * kNoise_rad, known * kNoise_m});
  }
  return poses;
}

struct Error {
  double m = 0, rad = 0;
};

Error error_of(const std::vector<Pose>& poses, const std::vector<Pose>& truth) {
  Error error;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double m = norm(poses[i].translation - truth[i].translation),
                 rad = rotation_angle(poses[i].inverse() * truth[i]);
    error.m += m * m / static_cast<double>(truth.size());
    error.rad += rad * rad / static_cast<double>(truth.size());
  }
  return {std::sqrt(error.m), std::sqrt(error.rad)};
}

std::vector<Pose> raw(const std::vector<MeasuredPose>& poses) {
  std::vector<Pose> result;
  for (const MeasuredPose& pose : poses) result.push_back(pose.world_from_camera);
  return result;
}

}  // namespace

TEST_CASE("smoothing takes out more than half of the noise of a slowly swaying camera") {
  const auto truth = swaying(300);
  const auto poses = measured(truth, 1);
  const Error before = error_of(raw(poses), truth), after = error_of(smoothed(poses), truth);
  CHECK(after.m < 0.5 * before.m);
  CHECK(after.rad < 0.5 * before.rad);
}

TEST_CASE("smoothing moves exact poses of a swaying camera by less than a hundredth of a millimetre") {
  const auto truth = swaying(300);
  const Error after = error_of(smoothed(measured(truth, 0)), truth);
  CHECK(after.m < 1e-5);
  CHECK(after.rad < 1e-5);
}

TEST_CASE("smoothing leaves a camera alone that shakes much more than its poses are noisy") {
  Noise shake;
  auto truth = swaying(300);
  for (Pose& pose : truth) {
    pose = pose * rotation_from(shake.next(0.01));
    pose.translation = pose.translation + shake.next(0.01);
  }
  // A walk: the camera goes on from where it was shaken to.
  for (std::size_t i = 1; i < truth.size(); ++i)
    truth[i].translation = truth[i - 1].translation + shake.next(0.03);
  const auto poses = measured(truth, 0.1);
  const Error after = error_of(smoothed(poses), truth);
  CHECK(after.m < 0.001);
  CHECK(after.rad < 0.001);
}

TEST_CASE("a pose that is known badly follows its neighbours") {
  const auto truth = swaying(100);
  auto poses = measured(truth, 0.3);
  poses[50].world_from_camera.translation.x += 0.1;
  poses[50].deviation_m = 0.1;
  CHECK(norm(smoothed(poses)[50].translation - truth[50].translation) < 0.003);
}

TEST_CASE("few poses stay as they are, and equal ones too") {
  const auto few = measured(swaying(9), 1);
  CHECK(smoothed(few) == raw(few));
  const auto still = measured(std::vector<Pose>(30), 0);
  CHECK(error_of(smoothed(still), raw(still)).m < 1e-9);
  CHECK(smoothed({}).empty());
}

TEST_CASE("a frame with few landmarks goes where its whole image lies against another camera's") {
  Pose other = rotation_from({0.05, 0.1, -0.1}), truth = rotation_from({0.1, -0.2, 0.3});
  other.translation = {1.1, 0.3, -2};
  truth.translation = {1.4, -0.1, -2.2};
  AlignedView view{other, truth * other.inverse(), {}};
  for (int i = 0; i < 6; ++i) view.information[7 * i] = 1e10;
  const Pinhole pinhole = track::test::test_pinhole();
  auto few = track::test::observe(track::test::scattered_points(4), truth, pinhole);
  for (Correspondence& seen : few) seen.measurement.u_px += 0.3;
  Pose start = rotation_from({0.02, -0.02, 0.01}) * truth;
  const auto found = estimate_pose(few, pinhole, start, {&view, 1}).camera_from_world;
  CHECK(norm(found.translation - truth.translation) < 1e-4);
  CHECK(rotation_angle(found * truth.inverse()) < 1e-4);
  CHECK(norm(estimate_pose(few, pinhole, start).camera_from_world.translation - truth.translation) > 2e-4);
}
