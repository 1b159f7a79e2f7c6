#include "stages/movers/regions.hpp"

#include <catch2/catch.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/scene/frame.hpp"
#include "stages/movers/other_view.hpp"

using namespace sediment;
using namespace sediment::movers;

namespace {

constexpr double kScale = 5000;
const Camera kSmallCamera{160, 120, 150, 150, 79.5, 59.5, {}, kScale};
const cv::Rect kThing(20, 15, 20, 15);  ///< cells

Verdicts verdicts_with(const cv::Rect& cells, int through, int hits) {
  Verdicts verdicts{cv::Mat(60, 80, CV_8UC1, cv::Scalar(0)), cv::Mat(60, 80, CV_8UC1, cv::Scalar(9)),
                    cv::Mat(60, 80, CV_8UC1, cv::Scalar(0)), cv::Mat(60, 80, CV_8UC1, cv::Scalar(255))};
  verdicts.through(cells) = through;
  verdicts.hits(cells) = hits;
  return verdicts;
}

cv::Mat depth_with(const cv::Rect& cells, double depth_m) {
  cv::Mat depth(120, 160, CV_16UC1, cv::Scalar(3 * kScale));
  depth(cv::Rect(cells.tl() * kStep_px, cells.size() * kStep_px)) = depth_m * kScale;
  return depth;
}

View view_with(const cv::Rect& cells, double depth_m) {
  return {0, {}, {}, depth_with(cells, depth_m), cv::Mat(120, 160, CV_8UC1, cv::Scalar(kStatic))};
}

int count_of(const Verdicts& verdicts, const RegionParameters& parameters = {}) {
  return cv::countNonZero(regions_of(verdicts, view_with(kThing, 1.5), kScale, parameters));
}

}  // namespace

TEST_CASE("a region needs enough frames that see through it, and the majority of those that say anything") {
  CHECK(count_of(verdicts_with(kThing, 3, 2)) > 0.95 * kThing.area());
  CHECK(count_of(verdicts_with(kThing, 2, 0)) == 0);
  CHECK(count_of(verdicts_with(kThing, 5, 5)) == 0);
}

TEST_CASE("thin lines and small spots are no regions") {
  CHECK(count_of(verdicts_with({20, 15, 40, 2}, 9, 0)) == 0);
  CHECK(count_of(verdicts_with({20, 15, 4, 4}, 9, 0), {.min_area = 0.01}) == 0);
}

TEST_CASE("a seed grows over its surface where frames disagree, and not to another depth") {
  Verdicts verdicts = verdicts_with(kThing, 3, 9);  // a quarter sees through it
  const cv::Rect seed(kThing.x, kThing.y, 6, kThing.height);
  verdicts.hits(seed) = 0;
  CHECK(count_of(verdicts) > 0.95 * kThing.area());
  verdicts.through = 3;  // the wall around as well, but it lies deeper
  CHECK(count_of(verdicts) < 1.05 * kThing.area());
}

TEST_CASE(
    "what has come to stay is whole: parts not seen both before and after, with something behind them that "
    "is") {
  Verdicts verdicts = verdicts_with(kThing, 0, 9);
  const cv::Rect seed(kThing.x, kThing.y, 6, kThing.height);
  verdicts.through(seed) = 9;
  verdicts.hits(seed) = 0;
  const int alone = count_of(verdicts);
  CHECK(alone < 1.2 * seed.area());
  verdicts.lasting(kThing) = 0;
  CHECK(count_of(verdicts) == alone);  // floor that comes into sight
  verdicts.beyond(kThing) = 2;
  CHECK(count_of(verdicts) == alone);  // too few
  verdicts.beyond(kThing) = 3;
  CHECK(count_of(verdicts) > 0.95 * kThing.area());
  verdicts.lasting(kThing) = 255;
  CHECK(count_of(verdicts) == alone);  // it has always been there
}

TEST_CASE("the rest of a thing that is masked as moved already joins, that of a person does not") {
  Verdicts verdicts = verdicts_with(kThing, 0, 9);
  verdicts.lasting(kThing) = 0;
  verdicts.beyond(kThing) = 9;
  View view = view_with(kThing, 1.5);
  CHECK(cv::countNonZero(regions_of(verdicts, view, kScale, {})) == 0);
  const cv::Rect masked(kThing.tl() * kStep_px, cv::Size(6, kThing.height) * kStep_px);
  view.dynamic(masked) = kNonPriorDynamic;
  CHECK(cv::countNonZero(regions_of(verdicts, view, kScale, {})) > 0.95 * (kThing.width - 6) * kThing.height);
  view.dynamic(masked) = kPriorDynamic;
  CHECK(cv::countNonZero(regions_of(verdicts, view, kScale, {})) == 0);
}

TEST_CASE("the outline takes pixels of the same depth beside the cells, and leaves the background") {
  const cv::Rect inner(kThing.x + 1, kThing.y + 1, kThing.width - 2, kThing.height - 2);
  cv::Mat regions(60, 80, CV_8UC1, cv::Scalar(0));
  regions(inner) = 255;
  const cv::Mat mask = outlined(regions, depth_with(kThing, 1.5), kScale, 4);
  CHECK(cv::countNonZero(mask) == kThing.area() * kStep_px * kStep_px);
}

TEST_CASE("another frame confirms a region that it shows nearby or has masked, and no other") {
  cv::Mat here(60, 80, CV_8UC1, cv::Scalar(0)), there = here.clone();
  here(kThing) = 255;
  View view = view_with(kThing, 1.5), other = view;
  const auto confirmed = [&] {
    return cv::countNonZero(confirmed_by(here, view, there, other, kSmallCamera, rays_of(kSmallCamera), 8));
  };
  CHECK(confirmed() == 0);
  there(kThing + cv::Point(3, 0)) = 255;
  CHECK(confirmed() == kThing.area());
  there = 0;
  there(kThing + cv::Point(18, 0)) = 255;
  CHECK(confirmed() == 0);
  other.dynamic(cv::Rect(kThing.tl() * kStep_px, kThing.size() * kStep_px)) = kPriorDynamic;
  CHECK(confirmed() == kThing.area());
}

TEST_CASE("a frame carries its regions to where the other shows the same surface in the same place") {
  cv::Mat there(60, 80, CV_8UC1, cv::Scalar(0));
  there(kThing) = 255;
  const View other = view_with(kThing, 1.5);
  View view = other;
  const auto carried = [&] {
    return cv::countNonZero(carried_from(there, other, view, kSmallCamera, rays_of(kSmallCamera)));
  };
  CHECK(carried() == kThing.area());
  view = view_with(kThing + cv::Point(5, 0), 1.5);  // it has moved by a quarter of its width
  CHECK(carried() == 0.75 * kThing.area());
  view = view_with(kThing, 1.7);
  CHECK(carried() == 0);
  view = other;
  there = 0;
  CHECK(carried() == 0);
}
