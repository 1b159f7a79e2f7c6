#include <catch2/catch.hpp>
#include <stdexcept>

#include "stages/interaction-mask/dynamic_mask.hpp"
#include "tests/stages/interaction-mask/random_scene.hpp"

using namespace sediment;
using namespace sediment::interaction_mask;

namespace {

const LabelTable kLabels({{0, "person", {}, true}, {56, "chair", {}, false}, {101, "floor", {}, false}});
constexpr double kScale = 5000;

/// A person in columns 10..19 and a chair in columns 20..29, rows 5..14, one metre away and `apart_m` behind.
struct Touch {
  InstanceMask mask{cv::Mat(20, 40, CV_16UC1, cv::Scalar(0)), {{1, "person"}, {2, "chair"}}};
  cv::Mat depth = cv::Mat(20, 40, CV_16UC1, cv::Scalar(0));
  explicit Touch(double apart_m) {
    mask.ids(cv::Rect(10, 5, 10, 10)) = 1;
    mask.ids(cv::Rect(20, 5, 10, 10)) = 2;
    depth(cv::Rect(10, 5, 10, 10)) = kScale;
    depth(cv::Rect(20, 5, 10, 10)) = kScale * (1 + apart_m);
  }
};

/// The test and the picture of one frame, as the paper has it.
struct Classified : TouchedFrame {
  cv::Mat dynamic;
};

Classified classify(const InstanceMask& mask, const cv::Mat& depth, double depth_scale,
                    const LabelTable& labels, const TouchParameters& parameters) {
  Classified frame{find_touched(mask, depth, depth_scale, labels, parameters), {}};
  frame.dynamic = paint_dynamic(mask.ids, frame.prior_dynamic_ids, frame.touched_ids);
  return frame;
}

int count(const cv::Mat& mask, int value) {
  return cv::countNonZero(mask == value);
}

}  // namespace

TEST_CASE("a chair at the depth of the person beside it becomes non-prior dynamic") {
  const Touch touch(0.1);
  const Classified frame = classify(touch.mask, touch.depth, kScale, kLabels, {});
  CHECK(count(frame.dynamic, kPriorDynamic) == 100);
  CHECK(count(frame.dynamic, kNonPriorDynamic) == 100);
  REQUIRE(frame.pairs.size() == 1);
  CHECK(frame.pairs[0].interacting);
  CHECK(frame.pairs[0].mean_depth_difference_m == Approx(0.1));
  CHECK(frame.pairs[0].pixel_pairs == test::brute_force(touch.mask.ids, touch.depth, 1, 2, 6).pixel_pairs);
  CHECK(frame.prior_dynamic_ids == std::vector{1});
  CHECK(frame.touched_ids == std::set{2});
}

TEST_CASE("a chair half a metre behind the person stays static, and so does one at exactly the threshold") {
  for (const double apart_m : {0.5, 0.25}) {
    const Touch touch(apart_m);
    TouchParameters parameters;
    parameters.threshold_m = 0.25;
    const Classified frame = classify(touch.mask, touch.depth, kScale, kLabels, parameters);
    CHECK(count(frame.dynamic, kNonPriorDynamic) == 0);
    CHECK_FALSE(frame.pairs.at(0).interacting);
  }
}

TEST_CASE("the chair touched by the second of two persons is found, whoever touches it") {
  Touch touch(0.1);
  touch.mask.ids(cv::Rect(32, 5, 5, 10)) = 3;
  touch.depth(cv::Rect(32, 5, 5, 10)) = kScale * 3;
  touch.mask.instances.push_back({3, "person"});
  const Classified frame = classify(touch.mask, touch.depth, kScale, kLabels, {});
  CHECK(frame.pairs.size() == 2);
  CHECK(frame.touched_ids == std::set{2});
  CHECK(count(frame.dynamic, kNonPriorDynamic) == 100);
}

TEST_CASE("without depth there is no pair and nothing is set in motion, but the person stays masked") {
  Touch touch(0);
  touch.depth = 0;
  const Classified frame = classify(touch.mask, touch.depth, kScale, kLabels, {});
  CHECK(frame.pairs.empty());
  CHECK(count(frame.dynamic, kPriorDynamic) == 100);
  CHECK(count(frame.dynamic, kNonPriorDynamic) == 0);
}

TEST_CASE("too few pairs decide nothing") {
  const Touch touch(0);
  TouchParameters parameters;
  parameters.min_pairs = 1000000;
  const Classified frame = classify(touch.mask, touch.depth, kScale, kLabels, parameters);
  CHECK(frame.pairs.at(0).pixel_pairs > 0);
  CHECK_FALSE(frame.pairs[0].interacting);
  CHECK(count(frame.dynamic, kNonPriorDynamic) == 0);
}

TEST_CASE("a class that the table does not know is prior static and is named") {
  Touch touch(0);
  touch.mask.instances[1].class_name = "hoverboard";
  const Classified frame = classify(touch.mask, touch.depth, kScale, kLabels, {});
  CHECK(frame.unlisted == std::vector<std::string>{"hoverboard"});
  CHECK(count(frame.dynamic, kNonPriorDynamic) == 100);
}

TEST_CASE("the floor under a person's feet is not set in motion") {
  Touch touch(0);
  touch.mask.instances[1].class_name = "floor";
  CHECK(count(classify(touch.mask, touch.depth, kScale, kLabels, {}).dynamic, kNonPriorDynamic) == 0);
  TouchParameters everything_moves;
  everything_moves.immovable.clear();
  CHECK(count(classify(touch.mask, touch.depth, kScale, kLabels, everything_moves).dynamic,
              kNonPriorDynamic) == 100);
}

TEST_CASE("no instance, one person alone and a mask over the whole image are all fine") {
  const cv::Mat depth(20, 40, CV_16UC1, cv::Scalar(5000));
  InstanceMask none{cv::Mat(20, 40, CV_16UC1, cv::Scalar(0)), {}};
  CHECK(count(classify(none, depth, kScale, kLabels, {}).dynamic, kStatic) == 800);

  InstanceMask alone = none;
  alone.ids = cv::Mat(20, 40, CV_16UC1, cv::Scalar(7));
  alone.instances = {{7, "person"}};
  const Classified full = classify(alone, depth, kScale, kLabels, {});
  CHECK(count(full.dynamic, kPriorDynamic) == 800);
  CHECK(full.pairs.empty());

  alone.instances[0].class_name = "chair";
  CHECK(count(classify(alone, depth, kScale, kLabels, {}).dynamic, kStatic) == 800);
}

TEST_CASE("a mask of another size than the depth image is refused with both sizes") {
  const InstanceMask mask{cv::Mat(20, 40, CV_16UC1, cv::Scalar(0)), {}};
  CHECK_THROWS_WITH(classify(mask, cv::Mat(48, 64, CV_16UC1), kScale, kLabels, {}),
                    "the mask is 40x20, the depth image 64x48");
}
