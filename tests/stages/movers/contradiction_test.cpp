#include "stages/movers/contradiction.hpp"

#include <catch2/catch.hpp>

#include "pipeline/scene/frame.hpp"

using namespace sediment;
using namespace sediment::movers;

namespace {

const Camera kCamera{64, 48, 50, 50, 31.5, 23.5, {}, 5000};
/// One cell of the grid in the middle of the image.
const cv::Point kCell(16, 12);

View wall_at(double depth_m) {
  return {0,
          {},
          {},
          cv::Mat(48, 64, CV_16UC1, cv::Scalar(depth_m * kCamera.depth_scale)),
          cv::Mat(48, 64, CV_8UC1, cv::Scalar(kStatic))};
}

struct Votes {
  int through, hits;
  friend bool operator==(const Votes&, const Votes&) = default;
};

/// What one reference says of the middle of a view.
Votes votes_of(const View& view, const View& other, const ContradictionParameters& parameters = {}) {
  const Reference reference = reference_of(other, kCamera, parameters);
  const Reference* const references[] = {&reference};
  const Verdicts verdicts = verdicts_of(view, references, kCamera, rays_of(kCamera), parameters);
  return {verdicts.through.at<std::uint8_t>(kCell), verdicts.hits.at<std::uint8_t>(kCell)};
}

constexpr Votes kThrough{1, 0}, kHit{0, 1}, kNothing{0, 0};

}  // namespace

TEST_CASE("a frame sees through what is not there in it, sees what is, and says nothing of what it hides") {
  CHECK(votes_of(wall_at(1.5), wall_at(3)) == kThrough);
  CHECK(votes_of(wall_at(3), wall_at(3)) == kHit);
  CHECK(votes_of(wall_at(3), wall_at(1.5)) == kNothing);
}

TEST_CASE("what is seen both before and after is lasting, what is seen on one side only is not") {
  View view = wall_at(3), before = wall_at(3), after = wall_at(3);
  view.stamp_s = 1, after.stamp_s = 2;
  const auto lasting = [&](const View& first, const View& second) {
    const Reference references[] = {reference_of(first, kCamera, {}), reference_of(second, kCamera, {})};
    const Reference* const both[] = {&references[0], &references[1]};
    return verdicts_of(view, both, kCamera, rays_of(kCamera), {}).lasting.at<std::uint8_t>(kCell) == 255;
  };
  CHECK(lasting(before, after));
  CHECK_FALSE(lasting(after, after));
  CHECK_FALSE(lasting(before, before));
  View hidden = wall_at(1.5);
  CHECK_FALSE(lasting(hidden, after));
}

TEST_CASE("one frame of many before that shows a pixel's place filled makes it no lasting one") {
  View view = wall_at(1.5), shows = wall_at(1.5), after = wall_at(1.5);
  view.stamp_s = 1, after.stamp_s = 2;
  View through = wall_at(3);
  const auto lasting = [&](int frames_through) {
    std::vector<Reference> references{reference_of(shows, kCamera, {}), reference_of(after, kCamera, {})};
    for (int i = 0; i < frames_through; ++i) references.push_back(reference_of(through, kCamera, {}));
    std::vector<const Reference*> all;
    for (const Reference& reference : references) all.push_back(&reference);
    return verdicts_of(view, all, kCamera, rays_of(kCamera), {}).lasting.at<std::uint8_t>(kCell) == 255;
  };
  CHECK(lasting(1));
  CHECK_FALSE(lasting(2));  // a third sees it: a thing that glides is where it was, too
}

TEST_CASE("a frame sees beyond a pixel if what it shows there lies behind, though not all around does") {
  View view = wall_at(1.5), other = wall_at(3);
  other.depth.at<std::uint16_t>(25, 35) = 0;
  const ContradictionParameters wide{.slack_rad = 0.06};
  const auto beyond = [&] {
    const Reference reference = reference_of(other, kCamera, wide);
    const Reference* const one[] = {&reference};
    return verdicts_of(view, one, kCamera, rays_of(kCamera), wide).beyond.at<std::uint8_t>(kCell);
  };
  CHECK(beyond() == 1);
  other = wall_at(3);
  CHECK(beyond() == 0);  // that is through
  other = wall_at(1);
  CHECK(beyond() == 0);
}

TEST_CASE("depths may differ by the slack and four deviations of both") {
  // 0.03 + 4 * 0.0014 * sqrt(3^4 + 2.9^4) = 0.0989 m.
  CHECK(votes_of(wall_at(2.9), wall_at(2.9 + 0.09)) == kHit);
  CHECK(votes_of(wall_at(2.9), wall_at(2.9 + 0.11)) == kThrough);
}

TEST_CASE("one pixel of the window that is as near, or has no depth, keeps a frame from seeing through") {
  View other = wall_at(3);
  other.depth.at<std::uint16_t>(25, 35) = GENERATE(0, 7500);
  CHECK(votes_of(wall_at(1.5), other, {.slack_rad = 0.06}).through == 0);
  CHECK(votes_of(wall_at(1.5), other, {.slack_rad = 0.02}) == kThrough);
}

TEST_CASE("what moves in a frame confirms nothing there") {
  View other = wall_at(2);
  other.dynamic = kPriorDynamic;
  CHECK(votes_of(wall_at(2), other) == kNothing);
  CHECK(votes_of(wall_at(1), other) == kThrough);
}

TEST_CASE("the poses of both frames count") {
  View other = wall_at(3.5);
  other.world_from_camera.translation = {0, 0, -0.5};  // half a metre back: the wall is where it was
  CHECK(votes_of(wall_at(3), other) == kHit);
  CHECK(votes_of(wall_at(2.5), other) == kThrough);
  other.world_from_camera = pose_from({0, 1, 0, 0}, {});  // turned round: nothing is in sight
  CHECK(votes_of(wall_at(3), other) == kNothing);
}

TEST_CASE("frames that turn fast ask for a wider window, and say nothing when it would be too wide") {
  View other = wall_at(3);
  other.depth.at<std::uint16_t>(25, 36) = 7500;  // 3 pixels beside
  const ContradictionParameters parameters{.slack_rad = 0.02, .lag_s = 0.02};
  CHECK(votes_of(wall_at(1.5), other, parameters) == kThrough);
  other.speed.rad_s = 3;  // 0.08 rad: four pixels
  CHECK(votes_of(wall_at(1.5), other, parameters).through == 0);
  CHECK(votes_of(
            wall_at(1.5),
            [] {
              View fast = wall_at(3);
              fast.speed.rad_s = 6;
              return fast;
            }(),
            parameters) == kNothing);
}

TEST_CASE("frames that move fast differ in depth by their way in the lag") {
  View other = wall_at(3);
  other.speed.m_s = 2;
  CHECK(votes_of(wall_at(2.87), wall_at(3)) == kThrough);
  CHECK(votes_of(wall_at(2.87), other) == kHit);
}

TEST_CASE("steps of the depth and depths out of range are not judged") {
  View view = wall_at(1.5);
  view.depth.colRange(34, 64) = 5000;
  CHECK(votes_of(view, wall_at(3)) == kNothing);
  CHECK(votes_of(wall_at(0.3), wall_at(3)) == kNothing);
  CHECK(votes_of(wall_at(4.6), wall_at(6)) == kNothing);
}
