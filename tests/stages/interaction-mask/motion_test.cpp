#include "stages/interaction-mask/motion.hpp"

#include <catch2/catch.hpp>

#include "pipeline/scene/frame.hpp"
#include "stages/interaction-mask/halo.hpp"

using namespace sediment;
using namespace sediment::interaction_mask;

namespace {

const MotionParameters kExactly{.margin = 0};

/// One object (id 5) in 100 frames: at rest, 0.3 m/s in frames 40 .. 59, at rest; touched in the frames
/// given.
std::vector<std::vector<ObjectState>> pushed(int touch_first, int touch_last) {
  std::vector<std::vector<ObjectState>> frames;
  for (int i = 0; i < 100; ++i)
    frames.push_back({{5, i >= 40 && i < 60 ? 0.3 : 0.01, i >= touch_first && i <= touch_last}});
  return frames;
}

std::pair<int, int> dynamic_range(const std::vector<std::set<int>>& moved) {
  int first = -1, last = -1;
  for (int i = 0; i < static_cast<int>(moved.size()); ++i)
    if (moved[static_cast<std::size_t>(i)].contains(5)) {
      if (first < 0) first = i;
      last = i;
    }
  return {first, last};
}

}  // namespace

TEST_CASE("an object that is touched is dynamic from its first movement until it rests") {
  CHECK(dynamic_range(moved_objects(pushed(30, 80), kExactly)) == std::pair(40, 59));
  CHECK(dynamic_range(moved_objects(pushed(45, 45), kExactly)) == std::pair(40, 59));
}

TEST_CASE(
    "a touch shortly before or after the motion belongs to it, one long ago does not, and none moves "
    "nothing") {
  CHECK(dynamic_range(moved_objects(pushed(25, 25), kExactly)) == std::pair(40, 59));
  CHECK(dynamic_range(moved_objects(pushed(74, 74), kExactly)) == std::pair(40, 59));
  CHECK(dynamic_range(moved_objects(pushed(24, 24), kExactly)).first == -1);
  CHECK(dynamic_range(moved_objects(pushed(75, 75), kExactly)).first == -1);
  CHECK(dynamic_range(moved_objects(pushed(200, 200), kExactly)).first == -1);
}

TEST_CASE("a motion is longer by its margin on either side, as speeds are means over frames") {
  CHECK(dynamic_range(moved_objects(pushed(45, 45), {.margin = 2})) == std::pair(38, 61));
}

TEST_CASE("a chair that somebody sits on without moving it stays static") {
  std::vector<std::vector<ObjectState>> frames(50, {{5, 0.02, true}});
  CHECK(dynamic_range(moved_objects(frames, kExactly)).first == -1);
}

TEST_CASE("slow frames on the way neither end a motion nor begin one") {
  auto frames = pushed(40, 59);
  for (const std::size_t i : {45, 46, 47}) frames[i][0].speed_m_s = 0.06;
  frames[50][0].speed_m_s.reset();
  frames[52].clear();  // not seen
  CHECK(dynamic_range(moved_objects(frames, kExactly)) == std::pair(40, 59));
  for (auto& frame : frames)
    for (ObjectState& state : frame)
      if (state.speed_m_s) state.speed_m_s = std::min(*state.speed_m_s, 0.06);
  frames[50] = {{5, 0.06, true}};
  CHECK(dynamic_range(moved_objects(frames, kExactly)).first == -1);
}

TEST_CASE("two fast frames are an error of measurement, three a motion") {
  for (const int count : {2, 3}) {
    std::vector<std::vector<ObjectState>> frames(30, {{5, 0.0, true}});
    for (int i = 0; i < count; ++i) frames[static_cast<std::size_t>(10 + i)][0].speed_m_s = 0.4;
    CHECK((dynamic_range(moved_objects(frames, kExactly)).first == 10) == (count == 3));
  }
}

TEST_CASE("where a speed is not known the touch decides") {
  std::vector<std::vector<ObjectState>> frames(10, {{5, std::nullopt, false}});
  frames[4][0].touched = true;
  CHECK(dynamic_range(moved_objects(frames, kExactly)) == std::pair(4, 4));
}

TEST_CASE("the halo takes mixed depth beside what moves, and leaves the background and what has no depth") {
  cv::Mat dynamic(1, 12, CV_8UC1, cv::Scalar(kStatic));
  dynamic.colRange(0, 4) = kPriorDynamic;
  // 1 m: the mover; then none, 1.5 m (mixed), none, 2 m (wall) ..., none far away.
  const cv::Mat depth =
      (cv::Mat_<std::uint16_t>(1, 12) << 5000, 5000, 5000, 5000, 0, 7500, 0, 10000, 10000, 10000, 0, 10000);
  const cv::Mat grown = grow_over_halo(dynamic, depth, 5000, 3);
  const cv::Mat expected = (cv::Mat_<std::uint8_t>(1, 12) << 1, 1, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0);
  CHECK(cv::countNonZero(grown != expected) == 0);
  CHECK(cv::countNonZero(grow_over_halo(dynamic, depth, 5000, 0) != dynamic) == 0);
}
