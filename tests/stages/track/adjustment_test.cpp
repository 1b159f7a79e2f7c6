#include <tbb/global_control.h>

#include <catch2/catch.hpp>

#include "tests/stages/track/ceres_adjustment.hpp"
#include "tests/stages/track/scattered_points.hpp"

using namespace sediment;
using namespace sediment::track;
using namespace sediment::track::test;

namespace {

// Cameras along a line that see scattered points with noise, every 17th measurement far off, every third
// without depth, and a camera that turns while its rows are read.
Bundle noisy_bundle(int cameras, int points) {
  Bundle bundle;
  bundle.points = scattered_points(points);
  unsigned state = 99;
  const auto noise = [&state] {
    return ((state = state * 1664525u + 1013904223u) >> 8) / double(1u << 24) - 0.5;
  };
  for (int i = 0; i < cameras; ++i) {
    const double along = 6.0 * i / cameras;
    Pose pose = rotation_from({0.02 * along, -0.03 * along, 0.01 * along});
    pose.translation = {0.08 * along, 0.02 * along, -0.03 * along};
    const auto seen = observe(bundle.points, pose, test_pinhole());
    for (int j = 0; j < points; ++j) {
      if ((i + j) % 4 == 0) continue;
      Measurement m = seen[j].measurement;
      const double row = m.v_px / 480 - 0.5;
      m.u_rate = 900 * row * (i % 2 ? 1 : -1);
      m.v_rate = 300 * row;
      m.depth_rate = 0.2 * row;
      m.u_px += noise() + 0.02 * m.u_rate + (j % 17 == 0 ? 25 : 0);
      m.v_px += noise() + 0.02 * m.v_rate;
      m.inverse_depth = j % 3 == 0 ? 0 : m.inverse_depth + 0.002 * noise();
      bundle.observations.push_back({i, j, m});
    }
    bundle.cameras.push_back(
        {i == 0 ? pose : updated(pose, {0.004, -0.003, 0.002}, {0.01, 0.02, -0.01}), i == 0});
  }
  for (Vec3& point : bundle.points) point.z += 0.02 * noise();
  return bundle;
}

void compare(const Bundle& start, AdjustmentRule rule) {
  rule.max_iterations = 200;
  rule.least_gain = 1e-12;
  Bundle ours = start, reference = start;
  const double cost = adjust(ours, test_pinhole(), rule);
  const double reference_cost = adjust_with_ceres(reference, test_pinhole(), rule);
  CHECK(cost == Approx(reference_cost).epsilon(1e-6));
  for (std::size_t i = 0; i < start.cameras.size(); ++i)
    CHECK(norm(ours.cameras[i].camera_from_world.translation -
               reference.cameras[i].camera_from_world.translation) < 2e-4);
  CHECK(ours.timing.readout_s == Approx(reference.timing.readout_s).margin(1e-4));
  CHECK(ours.timing.depth_lag_s == Approx(reference.timing.depth_lag_s).margin(1e-3));
}

}  // namespace

TEST_CASE("an adjustment finds the minimum that Ceres finds, with a robust loss and without") {
  compare(noisy_bundle(6, 120), {50, true});
  compare(noisy_bundle(6, 120), {50, false});
}

TEST_CASE("an adjustment finds the timing of the sensor that Ceres finds") {
  const Bundle bundle = noisy_bundle(6, 120);
  compare(bundle, {50, true, true});
  Bundle timed = bundle;
  adjust(timed, test_pinhole(), {50, true, true});
  CHECK(timed.timing.readout_s == Approx(-0.02).margin(0.002));
}

TEST_CASE("an adjustment with links between cameras finds the minimum that Ceres finds") {
  Bundle bundle = noisy_bundle(5, 40);
  for (int i = 1; i < 5; ++i) {
    const Pose& from = bundle.cameras[i - 1].camera_from_world;
    Bundle::Link link{i - 1, i, bundle.cameras[i].camera_from_world * from.inverse(), {}};
    for (int k = 0; k < 6; ++k) link.information[7 * k] = 1e5 * (k + 1);
    link.information[1] = link.information[6] = 3e4;
    bundle.links.push_back(link);
  }
  compare(bundle, {50, true});
}

TEST_CASE(
    "an adjustment of many cameras, whose system is sparse, ends where Ceres finds nothing to improve") {
  Bundle bundle = noisy_bundle(50, 150);
  std::erase_if(bundle.observations,
                [](const Bundle::Observation& o) { return std::abs(o.camera_idx - o.point_idx / 3) > 4; });
  // Such a chain has several minima, a hundredth of a percent apart: from one start the two need not end in
  // the same.
  const AdjustmentRule rule{200, true, false, false, 1e-12};
  Bundle ours = bundle;
  const double cost = adjust(ours, test_pinhole(), rule);
  Bundle from_ours = ours;
  CHECK(cost < (1 + 1e-6) * adjust_with_ceres(from_ours, test_pinhole(), rule));
  for (std::size_t i = 0; i < ours.cameras.size(); ++i)
    CHECK(norm(ours.cameras[i].camera_from_world.translation -
               from_ours.cameras[i].camera_from_world.translation) < 2e-4);
}

TEST_CASE("an adjustment on several threads gives the bits of one") {
  for (const bool timing : {false, true}) {
    Bundle alone = noisy_bundle(8, 200), spread = alone;
    adjust(alone, test_pinhole(), {10, true, timing, false});
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
    adjust(spread, test_pinhole(), {10, true, timing, true});
    for (std::size_t i = 0; i < alone.cameras.size(); ++i)
      CHECK(alone.cameras[i].camera_from_world == spread.cameras[i].camera_from_world);
    CHECK(alone.points == spread.points);
    CHECK(alone.timing.readout_s == spread.timing.readout_s);
  }
}

TEST_CASE("an adjustment that starts with a point behind a camera is an error") {
  Bundle bundle = noisy_bundle(2, 10);
  bundle.points[3].z = -1;
  CHECK_THROWS_WITH(adjust(bundle, test_pinhole(), {5, true}), Catch::Contains("behind a camera"));
}
