#include <tbb/global_control.h>
#include <catch2/catch.hpp>

#include "stages/track/track.hpp"
#include "tests/stages/track/box_room.hpp"

using namespace sediment;
using namespace sediment::track;
using namespace sediment::track::test;

namespace {

Tracked run(const Recording& recording, int features = 700) {
  Parameters parameters;
  parameters.features = features;
  return track::track(recording, parameters, {});
}

int lost(const Tracked& tracked) {
  return static_cast<int>(tracked.frames.size() - tracked.poses.size());
}

}  // namespace

TEST_CASE("a camera that sways through a textured room is followed to within a few millimetres") {
  const auto truth = swaying_poses(60, 0.3, 0.4);
  Trouble kinect;
  kinect.depth_noise = 0.0014;
  const auto tracked = run(record_box_room(truth, small_camera(), kinect));
  CHECK(lost(tracked) == 0);
  CHECK(position_error_m(tracked, truth) < 0.006);
}

TEST_CASE("a camera that stands still does not drift") {
  const std::vector<Pose> truth(40);
  Trouble kinect;
  kinect.depth_noise = 0.0014;
  const auto tracked = run(record_box_room(truth, small_camera(), kinect));
  CHECK(lost(tracked) == 0);
  CHECK(position_error_m(tracked, truth) < 0.002);
}

TEST_CASE("the world is the first camera") {
  auto truth = swaying_poses(5, 0.3, 0.4);
  const auto tracked = run(record_box_room(truth, small_camera()));
  REQUIRE(tracked.poses.size() == 5);
  CHECK(norm(tracked.poses[0].world_from_camera.translation) < 1e-12);
  CHECK(rotation_angle(tracked.poses[0].world_from_camera) < 1e-7);
}

TEST_CASE("one and four threads give the same poses to the last bit") {
  const auto recording = record_box_room(swaying_poses(30, 0.3, 0.4), small_camera());
  std::vector<Tracked> results;
  for (const std::size_t threads : {1, 4}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(run(recording));
  }
  REQUIRE(results[0].poses.size() == results[1].poses.size());
  for (std::size_t i = 0; i < results[0].poses.size(); ++i)
    CHECK(results[0].poses[i].world_from_camera == results[1].poses[i].world_from_camera);
}

TEST_CASE("frames without light and depth are lost, and the camera is found again behind them") {
  const auto truth = swaying_poses(45, 0.3, 0.4);
  Trouble trouble;
  trouble.black = trouble.no_depth = [](std::size_t i) { return i >= 15 && i < 25; };
  const auto tracked = run(record_box_room(truth, small_camera(), trouble));
  for (std::size_t i = 0; i < 45; ++i)
    CHECK((tracked.frames[i].state == TrackingState::lost) == (i >= 15 && i < 25));
  CHECK(position_error_m(tracked, truth) < 0.008);
}

TEST_CASE(
    "in the dark a camera is followed by depth alone into a corner of the room, and lost before one wall") {
  Trouble trouble;
  trouble.black = [](std::size_t i) { return i >= 8 && i < 12; };
  auto truth = swaying_poses(20, 0.3, 0.4);
  CHECK(lost(run(record_box_room(truth, small_camera(), trouble))) == 4);
  for (Pose& pose : truth) pose = rotation_from({-0.5, 0, 0}) * rotation_from({0, 0.7, 0}) * pose;
  const auto tracked = run(record_box_room(truth, small_camera(), trouble));
  CHECK(lost(tracked) == 0);
  CHECK(tracked.frames[10].inliers == 0);
  CHECK(position_error_m(tracked, truth) < 0.02);
}

TEST_CASE("frames under a mask as large as the image are lost, not invented") {
  Trouble trouble;
  trouble.masked = [](std::size_t i) { return i == 6 || i == 7; };
  const auto truth = swaying_poses(12, 0.3, 0.4);
  const auto tracked = run(record_box_room(truth, small_camera(), trouble));
  CHECK(lost(tracked) == 2);
  CHECK(tracked.frames[6].state == TrackingState::lost);
  CHECK(tracked.frames[7].inliers == 0);
}

TEST_CASE("a recording without any depth, light or static pixel has no pose") {
  const auto always = [](std::size_t) { return true; };
  for (const Trouble& trouble : {Trouble{always, {}, {}}, Trouble{{}, always, {}}, Trouble{{}, {}, always}}) {
    const auto tracked = run(record_box_room(swaying_poses(4, 0.3, 0.4), small_camera(), trouble));
    CHECK(tracked.poses.empty());
    CHECK(lost(tracked) == 4);
    CHECK_THROWS_WITH(require_coverage(tracked.frames, 0.5), Catch::Contains("lost 4 of 4 frames"));
  }
}

TEST_CASE("recordings of no frame, one frame and two frames are tracked") {
  for (const std::size_t frames : {0, 1, 2}) {
    const auto tracked = run(record_box_room(swaying_poses(frames, 0.3, 0.4), small_camera()));
    CHECK(tracked.poses.size() == frames);
    CHECK(tracked.frames.size() == frames);
  }
}

TEST_CASE("time that goes backwards is an error that names both frames") {
  auto recording = record_box_room(swaying_poses(3, 0.3, 0.4), small_camera());
  std::swap(recording.stamps[1], recording.stamps[2]);
  std::swap(recording.stamps_s[1], recording.stamps_s[2]);
  CHECK_THROWS_WITH(run(recording), Catch::Contains("frame 2") && Catch::Contains(recording.stamps[1]));
}

TEST_CASE("a camera carried elsewhere in a gap of five seconds is found again") {
  auto truth = swaying_poses(30, 0.3, 0.4);
  auto recording = record_box_room(truth, small_camera());
  for (std::size_t i = 15; i < 30; ++i) {
    truth[i] = truth[29 - i];
    recording.stamps_s[i] += 5;
  }
  auto moved = record_box_room(truth, small_camera());
  recording.frame = moved.frame;
  const auto tracked = run(recording);
  CHECK(lost(tracked) == 0);
  CHECK(position_error_m(tracked, truth) < 0.008);
}
