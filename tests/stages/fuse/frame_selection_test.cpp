#include "stages/fuse/frame_selection.hpp"

#include <catch2/catch.hpp>
#include <cstdio>

using namespace sediment;
using namespace sediment::fuse;

namespace {

std::string text(double stamp_s) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6f", stamp_s);
  return buffer;
}

/// 30 Hz from 100 s on.
std::vector<FrameStamp> frames_at_30_hz(int count) {
  std::vector<FrameStamp> frames;
  for (int i = 0; i < count; ++i) frames.push_back({text(100 + i / 30.0), 100 + i / 30.0});
  return frames;
}

/// The camera is at x = (time - 100 s) * 1 m/s.
StampedPose pose_of(double stamp_s, const std::string& stamp) {
  return {stamp, stamp_s, pose_from({}, {stamp_s - 100, 0, 0})};
}

std::vector<std::size_t> indices(const Selection& selection) {
  std::vector<std::size_t> found;
  for (const PosedFrame& frame : selection.frames) found.push_back(frame.frame_idx);
  return found;
}

}  // namespace

TEST_CASE("all frames with a pose of their stamp are taken, the others are named") {
  const auto frames = frames_at_30_hz(5);
  Trajectory trajectory;
  for (const std::size_t i : {0, 1, 4}) trajectory.push_back(pose_of(frames[i].stamp_s, frames[i].stamp));
  const Selection selection = select_frames(frames, trajectory, {}, FrameChoice::all, 1);
  CHECK(indices(selection) == std::vector<std::size_t>{0, 1, 4});
  CHECK(selection.without_pose == std::vector{frames[2].stamp, frames[3].stamp});
  CHECK(selection.frames[2].world_from_camera.translation.x == Approx(4 / 30.0));
}

TEST_CASE("a frame that tracking lost does not get its neighbour's pose, however close") {
  // 120 Hz: the next frame is 8 ms away, nearer than TUM's tolerance.
  std::vector<FrameStamp> frames;
  Trajectory trajectory;
  for (int i = 0; i < 10; ++i) {
    frames.push_back({text(100 + i / 120.0), 100 + i / 120.0});
    if (i < 4) trajectory.push_back(pose_of(frames.back().stamp_s, frames.back().stamp));
  }
  CHECK(indices(select_frames(frames, trajectory, {}, FrameChoice::all, 1)) ==
        std::vector<std::size_t>{0, 1, 2, 3});
}

TEST_CASE("a trajectory of motion capture is interpolated at the frames' times") {
  const auto frames = frames_at_30_hz(10);
  Trajectory trajectory;
  for (int i = 0; i < 25; ++i)
    trajectory.push_back(pose_of(100.0013 + i / 100.0, "mocap " + std::to_string(i)));
  const Selection selection = select_frames(frames, trajectory, {}, FrameChoice::all, 1);
  // The first frame is 1.3 ms before the first pose; the last two come too late.
  CHECK(indices(selection) == std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7});
  for (const PosedFrame& frame : selection.frames) {
    INFO("frame " << frame.frame_idx);
    const double slack_m = frame.frame_idx == 0 ? 0.0014 : 1e-9;
    CHECK(std::abs(frame.world_from_camera.translation.x - frame.frame_idx / 30.0) <= slack_m);
  }
  CHECK(selection.without_pose.size() == 2);
}

TEST_CASE("stamps that differ in their digits only still belong together, frame by frame") {
  std::vector<FrameStamp> frames;
  Trajectory trajectory;
  for (int i = 0; i < 4; ++i) {
    frames.push_back({text(100 + 0.7 * i), 100 + 0.7 * i});
    trajectory.push_back(pose_of(100.004 + 0.7 * i, "rounded " + std::to_string(i)));
  }
  const Selection selection = select_frames(frames, trajectory, {}, FrameChoice::all, 1);
  REQUIRE(indices(selection) == std::vector<std::size_t>{0, 1, 2, 3});
  CHECK(selection.frames[3].world_from_camera.translation.x == Approx(2.104));
}

TEST_CASE("keyframes choose their own frames, each once, and every n-th counts from the first") {
  const auto frames = frames_at_30_hz(10);
  Trajectory trajectory;
  for (const FrameStamp& frame : frames) trajectory.push_back(pose_of(frame.stamp_s, frame.stamp));
  const Trajectory keyframes{trajectory[7], trajectory[2], pose_of(100 + 2 / 30.0 + 0.001, "near the third"),
                             pose_of(250, "far away")};
  CHECK(indices(select_frames(frames, trajectory, keyframes, FrameChoice::keyframes, 1)) ==
        std::vector<std::size_t>{2, 7});
  CHECK(indices(select_frames(frames, trajectory, keyframes, FrameChoice::every_nth, 4)) ==
        std::vector<std::size_t>{0, 4, 8});
}
