#include "pipeline/scene/trajectory.hpp"

#include <catch2/catch.hpp>

using namespace sediment;

namespace {

Trajectory at(std::initializer_list<double> stamps_s) {
  Trajectory trajectory;
  for (const double s : stamps_s) trajectory.push_back({std::to_string(s), s, pose_from({}, {10 * s, 0, 0})});
  return trajectory;
}

}  // namespace

TEST_CASE("the nearest pose is found within the tolerance") {
  const Trajectory trajectory = at({1, 2, 4});
  CHECK(nearest_pose(trajectory, 0.9, 0.2) == 0u);
  CHECK(nearest_pose(trajectory, 1.6, 1) == 1u);
  CHECK(nearest_pose(trajectory, 9, 5) == 2u);
  CHECK_FALSE(nearest_pose(trajectory, 3.1, 0.5));
  CHECK_FALSE(nearest_pose({}, 1, 100));
}

TEST_CASE("a pose between two is interpolated, not beyond the ends and not within a gap") {
  const Trajectory trajectory = at({1, 2, 4});
  CHECK(pose_at(trajectory, 1.25, 1)->translation.x == Approx(12.5));
  CHECK(pose_at(trajectory, 2, 0)->translation.x == 20);
  CHECK(pose_at(trajectory, 1, 0)->translation.x == 10);
  CHECK_FALSE(pose_at(trajectory, 3, 1.9));
  CHECK(pose_at(trajectory, 3, 2)->translation.x == Approx(30));
  CHECK_FALSE(pose_at(trajectory, 0.99, 1));
  CHECK_FALSE(pose_at(trajectory, 4.01, 1));
  CHECK_FALSE(pose_at({}, 1, 1));
}
