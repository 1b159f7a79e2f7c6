#include "stages/project2d/up_hint.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <numbers>

#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::project2d;

namespace {

/// A camera that looks along the world's y and rolls; z of the world is up.
Trajectory rolling_camera() {
  const Pose level{{1, 0, 0, 0, 0, 1, 0, -1, 0}, {}};
  Trajectory trajectory;
  for (int i = 0; i < 30; ++i)
    trajectory.push_back({"", 10 + 0.1 * i, level * rotation_from({0, 0, 0.02 * i})});
  return trajectory;
}

void write_gravity(const std::filesystem::path& file, const Trajectory& trajectory, double sign) {
  std::ofstream stream(file);
  stream << "# timestamp ax ay az\n";
  for (const StampedPose& pose : trajectory) {
    const Vec3 felt = pose.world_from_camera.inverse().rotate({0, 0, sign * 9.81});
    stream << pose.stamp_s << ' ' << felt.x << ' ' << felt.y << ' ' << felt.z << '\n';
  }
}

}  // namespace

TEST_CASE("up comes from the accelerometer, whatever the sign of its readings") {
  const test::TemporaryFolder folder;
  const Trajectory trajectory = rolling_camera();
  const UpHint by_posture = up_from_trajectory(trajectory);
  for (const double sign : {1.0, -1.0}) {
    write_gravity(folder / "accelerometer.txt", trajectory, sign);
    const auto up = up_from_accelerometer(folder / "accelerometer.txt", trajectory, by_posture);
    REQUIRE(up);
    CHECK(up->up.z == Approx(1).epsilon(1e-4));
    CHECK(up->within_deg == 10);
  }
}

TEST_CASE("an accelerometer whose readings fall on no pose says nothing, a damaged file is an error") {
  const test::TemporaryFolder folder;
  const Trajectory trajectory = rolling_camera();
  const UpHint by_posture = up_from_trajectory(trajectory);
  std::ofstream(folder / "few.txt") << "10.5 0 -9.8 0\n99 0 -9.8 0\n";
  CHECK_FALSE(up_from_accelerometer(folder / "few.txt", trajectory, by_posture));
  std::ofstream(folder / "bad.txt") << "10.5 0 -9.8\n";
  CHECK_THROWS_WITH(up_from_accelerometer(folder / "bad.txt", trajectory, by_posture),
                    Catch::Contains("bad.txt:1"));
}
