#include "pipeline/artifacts/trajectory_file.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>

#include "pipeline/artifacts/file_bytes.hpp"
#include "tests/support/needs.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

Trajectory some_poses() {
  Trajectory poses;
  for (int i = 0; i < 5; ++i) {
    Pose pose = rotation_from({0.3 * i, -0.7, 0.1 * i * i});
    pose.translation = {1.0 / 3 * i, -2.5, 1e-9 * i};
    poses.push_back({"1305031102." + std::to_string(175304 + i), 1305031102.175304 + 1e-6 * i, pose});
  }
  return poses;
}

}  // namespace

TEST_CASE("a trajectory survives writing and reading to nine decimals, its stamps to the letter") {
  const test::TemporaryFolder folder;
  const Trajectory poses = some_poses();
  write_tum_trajectory(folder / "t.txt", poses);
  const Trajectory read = read_tum_trajectory(folder / "t.txt");
  REQUIRE(read.size() == poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CHECK(read[i].stamp == poses[i].stamp);
    const Pose difference = read[i].world_from_camera.inverse() * poses[i].world_from_camera;
    CHECK(norm(difference.translation) < 3e-9);
    CHECK(rotation_angle(difference) < 1e-7);
  }
}

TEST_CASE(
    "TUM's dialects are read: comments, commas, windows lines, another order, unnormalised quaternions") {
  const test::TemporaryFolder folder;
  write_bytes(folder / "t.txt", {"# timestamp tx ty tz qx qy qz qw\r\n2,1,2,3,0,0,0,2\r\n\r\n"
                                 "  1.5\t+4  5 6e0 0 0 1 0 \r\n"});
  const Trajectory read = read_tum_trajectory(folder / "t.txt");
  REQUIRE(read.size() == 2);
  CHECK(read[0].stamp == "1.5");
  CHECK(read[0].world_from_camera.translation == Vec3{4, 5, 6});
  CHECK(rotation_angle(read[0].world_from_camera) == Approx(3.14159265358979));
  CHECK(read[1].world_from_camera == pose_from({}, {1, 2, 3}));
}

TEST_CASE("a wrong trajectory is refused with its line") {
  const test::TemporaryFolder folder;
  const auto [line, expected] = GENERATE(table<std::string, std::string>(
      {{"3 1 2 3 0 0 0", "expected 8 columns (timestamp tx ty tz qx qy qz qw), found 7"},
       {"3 1 2 3 0 0 0 1 9", "expected 8 columns (timestamp tx ty tz qx qy qz qw), found 9"},
       {"3 1 nan 3 0 0 0 1", "expected a number for ty, found \"nan\""},
       {"3 1 2 inf 0 0 0 1", "expected a number for tz, found \"inf\""},
       {"3 1 2 3 0 0 0 0", "a quaternion of a pose has no direction"},
       {"three 1 2 3 0 0 0 1", "expected a number for timestamp, found \"three\""},
       {"1.0 1 2 3 0 0 0 1", "stamp 1.0 is given twice (first in line 1)"}}));
  write_bytes(folder / "t.txt", {"1 1 2 3 0 0 0 1\n", line, "\n"});
  CHECK_THROWS_WITH(read_tum_trajectory(folder / "t.txt"), Contains("t.txt:2: " + expected));
}

TEST_CASE("of two nearly equal true poses with one stamp the last counts, of two different ones none") {
  const test::TemporaryFolder folder;
  const auto file = folder / "groundtruth.txt";
  write_bytes(file, {"1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n2 0.009 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n"});
  const GroundTruth truth = read_ground_truth(file);
  REQUIRE(truth.trajectory.size() == 3);
  CHECK(truth.repeated == 1);
  CHECK(truth.trajectory[1].world_from_camera.translation.x == 0.009);
  CHECK_THROWS_WITH(read_tum_trajectory(file), Contains(":3: stamp 2 is given twice (first in line 2)"));
  write_bytes(file, {"1 0 0 0 0 0 0 1\n1 0.011 0 0 0 0 0 1\n"});
  CHECK_THROWS_WITH(read_ground_truth(file), Contains(":2: stamp 1 is given twice"));
  write_bytes(file, {"1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0.01 1\n"});
  CHECK_THROWS_WITH(read_ground_truth(file), Contains(":2: stamp 1 is given twice"));
}

TEST_CASE("the trajectory folder holds all poses, the keyframes and what tracking says of each frame") {
  const test::TemporaryFolder folder;
  const Trajectory poses = some_poses();
  std::vector<FrameTracking> frames;
  for (const StampedPose& pose : poses)
    frames.push_back({pose.stamp, TrackingState::tracked, false, 100, 90, 0.5, 0});
  frames[0].keyframe = frames[3].keyframe = true;
  frames.push_back({"1305031103", TrackingState::lost, false, 3, 0, 0, 2});
  write_trajectory(folder.path(), poses, frames);
  CHECK(read_trajectory(folder.path()).size() == 5);
  const Trajectory keyframes = read_keyframes(folder.path());
  REQUIRE(keyframes.size() == 2);
  CHECK(keyframes[1].stamp == poses[3].stamp);
  const auto tracking = read_tracking(folder.path());
  REQUIRE(tracking.size() == 6);
  CHECK(tracking[3].keyframe);
  CHECK(tracking[3].inliers == 90);
  CHECK(tracking[4].state == TrackingState::tracked);
  CHECK(tracking[5].state == TrackingState::lost);
  CHECK(tracking[5].stamp == "1305031103");
  CHECK(tracking[4].segment == 0);
  CHECK(tracking[5].segment == 2);
  frames.back().keyframe = true;
  CHECK_THROWS_WITH(write_trajectory(folder.path(), poses, frames),
                    Contains("keyframe 1305031103 has no pose"));
}

TEST_CASE("a pose that is not finite is never written") {
  const test::TemporaryFolder folder;
  Trajectory poses = some_poses();
  poses[2].world_from_camera.translation.y = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(write_tum_trajectory(folder / "t.txt", poses), Contains(poses[2].stamp));
}

TEST_CASE("TUM's own ground truth is read in full") {
  const auto file = test::needs("tum/trajectories/freiburg3_walking_xyz/groundtruth.txt");
  if (!file) return;
  const Trajectory truth = read_tum_trajectory(*file);
  CHECK(truth.size() > 2000);
  CHECK(std::is_sorted(truth.begin(), truth.end(), [](auto& a, auto& b) { return a.stamp_s < b.stamp_s; }));
}
