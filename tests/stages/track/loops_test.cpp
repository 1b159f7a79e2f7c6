#include <catch2/catch.hpp>
#include <cmath>

#include "stages/track/track.hpp"
#include "tests/stages/track/box_room.hpp"

using namespace sediment;
using namespace sediment::track;
using namespace sediment::track::test;

namespace {

constexpr double kTurn = 2 * M_PI;

Tracked run(const Recording& recording) {
  Parameters parameters;
  parameters.features = 700;
  return track::track(recording, parameters, {});
}

// A hand-held camera that looks to these sides one after the other, radians from straight ahead.
std::vector<Pose> looking(const std::vector<double>& sides) {
  std::vector<Pose> poses = swaying_poses(sides.size(), 0.2, 0.05);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Pose turn = rotation_from({0, sides[i], 0});
    const Vec3 place = poses[i].translation;
    poses[i] = turn * poses[i];
    poses[i].translation = place;
  }
  return poses;
}

std::vector<double> joined(std::vector<double> first, const std::vector<double>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<double> from_to(double first, double last, int frames) {
  std::vector<double> sides;
  for (int i = 0; i < frames; ++i) sides.push_back(first + (last - first) * i / frames);
  return sides;
}

Trouble kinect(std::function<bool(std::size_t)> black = {}) {
  Trouble trouble;
  trouble.black = trouble.no_depth = std::move(black);
  trouble.depth_noise = 0.0014;
  return trouble;
}

}  // namespace

TEST_CASE("a camera that turns once round knows where it began") {
  const auto truth = looking(joined(from_to(0, kTurn, 130), from_to(kTurn, kTurn + 0.3, 10)));
  const auto tracked = run(record_box_room(truth, small_camera(), kinect()));
  CHECK(tracked.poses.size() == truth.size());
  CHECK(tracked.loops > 0);
  CHECK(position_error_m(tracked, truth) < 0.008);
}

TEST_CASE(
    "a camera that is carried elsewhere in the dark and comes back later has all its poses in one world") {
  const auto truth = looking(joined(from_to(0, 0.2, 30), from_to(kTurn / 2, kTurn, 70)));
  const auto tracked =
      run(record_box_room(truth, small_camera(), kinect([](std::size_t i) { return i >= 24 && i < 32; })));
  CHECK(tracked.segments == 1);
  for (std::size_t i = 0; i < truth.size(); ++i)
    CHECK((tracked.frames[i].state == TrackingState::lost) == (i >= 24 && i < 32));
  CHECK(position_error_m(tracked, truth) < 0.012);
}

TEST_CASE("a stretch whose place in the world nobody knows has no poses in it but a world of its own") {
  const auto truth = looking(joined(from_to(0, 0.2, 30), from_to(kTurn / 2, kTurn / 2 + 0.2, 20)));
  const auto tracked =
      run(record_box_room(truth, small_camera(), kinect([](std::size_t i) { return i >= 24 && i < 32; })));
  CHECK(tracked.segments == 2);
  CHECK(tracked.poses.size() == 24);
  for (std::size_t i = 0; i < truth.size(); ++i)
    CHECK((tracked.frames[i].state == TrackingState::tracked) == (i < 24));
  REQUIRE(tracked.apart.size() == 1);
  REQUIRE(tracked.apart.front().size() == 18);
  for (std::size_t i = 32; i < truth.size(); ++i) {
    CHECK(tracked.frames[i].segment == 1);
    const Pose pose = tracked.apart.front()[i - 32].world_from_camera, exact = truth[32].inverse() * truth[i];
    CHECK(norm(pose.translation - exact.translation) < 0.012);
  }
  CHECK(tracked.frames[0].segment == 0);
  CHECK(tracked.frames[28].segment == -1);
}

TEST_CASE("a causal pose does not know what comes after it") {
  auto truth = looking(from_to(0, 0.6, 40));
  const auto recording = record_box_room(truth, small_camera(), kinect());
  truth.resize(25);
  const auto beginning = record_box_room(truth, small_camera(), kinect());
  Parameters parameters;
  parameters.features = 700;
  parameters.mode = Mode::causal;
  const auto whole = track::track(recording, parameters, {}), part = track::track(beginning, parameters, {});
  REQUIRE(whole.poses.size() == 40);
  REQUIRE(part.poses.size() == 25);
  for (std::size_t i = 0; i < 25; ++i)
    CHECK(whole.poses[i].world_from_camera == part.poses[i].world_from_camera);
}
