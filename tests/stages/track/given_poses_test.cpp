#include <catch2/catch.hpp>
#include <cmath>

#include "stages/track/given_poses.hpp"

using namespace sediment;
using namespace sediment::track;

namespace {

StampedPose at(double stamp_s, double x) {
  StampedPose pose{std::to_string(stamp_s), stamp_s, {}};
  pose.world_from_camera.translation.x = x;
  return pose;
}

}  // namespace

TEST_CASE("given poses are interpolated to the frames, and a gap is lost") {
  const Trajectory given{at(1.0, 0), at(1.05, 1), at(2.0, 2), at(2.05, 3)};
  Trajectory poses;
  const auto frames = resample(given, {"a", "b", "c", "d", "e"}, {0.9, 1.025, 1.5, 2.05, 2.2}, 0.1, poses);
  REQUIRE(frames.size() == 5);
  CHECK(frames[0].state == TrackingState::lost);
  CHECK(frames[1].state == TrackingState::tracked);
  CHECK(frames[2].state == TrackingState::lost);
  CHECK(frames[3].state == TrackingState::tracked);
  CHECK(frames[4].state == TrackingState::lost);
  REQUIRE(poses.size() == 2);
  CHECK(poses[0].stamp == "b");
  CHECK(poses[0].world_from_camera.translation.x == Approx(0.5));
  CHECK(poses[1].world_from_camera.translation.x == Approx(3));
}

TEST_CASE("a given pose that is not finite is an error that names its stamp") {
  const Trajectory given{at(1.0, 0), at(1.05, std::nan(""))};
  Trajectory poses;
  CHECK_THROWS_WITH(resample(given, {"a"}, {1.0}, 0.1, poses),
                    Catch::Contains("1.05") && Catch::Contains("finite"));
}

TEST_CASE("gaps between given poses are counted and the longest is told") {
  const Trajectory given{at(1.0, 0), at(1.05, 1), at(2.0, 2), at(2.05, 3), at(4.5, 3)};
  const Gaps gaps = gaps_of(given, 0.1);
  CHECK(gaps.count == 2);
  CHECK(gaps.longest_s == Approx(2.45));
  CHECK(gaps_of(given, 3).count == 0);
  CHECK(gaps_of({}, 0.1).count == 0);
}

TEST_CASE("without given poses every frame is lost") {
  Trajectory poses;
  const auto frames = resample({}, {"a", "b"}, {1.0, 2.0}, 0.1, poses);
  CHECK(poses.empty());
  CHECK(frames.size() == 2);
  CHECK(frames[1].state == TrackingState::lost);
}
