#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "pipeline/contract/errors.hpp"
#include "stages/segment/detections.hpp"
#include "stages/segment/network/box_decoding.hpp"
#include "stages/segment/selection.hpp"

using namespace sediment::segment;
using Catch::Matchers::Contains;

namespace {

/// Anchors with boxes of 20 x 10 pixels around the given centres, and scores of two classes.
Prediction prediction_of(const std::vector<std::array<float, 4>>& x_y_scores) {
  Prediction prediction;
  prediction.anchors = cv::Mat::zeros(6, static_cast<int>(x_y_scores.size()), CV_32F);
  for (int i = 0; i < prediction.anchors.cols; ++i) {
    const auto& [x, y, first, second] = x_y_scores[static_cast<std::size_t>(i)];
    const std::array column = {x, y, 20.0f, 10.0f, first, second};
    for (int row = 0; row < 6; ++row)
      prediction.anchors.at<float>(row, i) = column[static_cast<std::size_t>(row)];
  }
  return prediction;
}

Selection selection(float confidence = 0.25f, float iou = 0.7f) {
  return {{confidence, confidence}, iou, 300};
}

std::vector<int> anchors_of(const std::vector<Detection>& detections) {
  std::vector<int> found;
  for (const Detection& each : detections) found.push_back(each.anchor_idx);
  return found;
}

}  // namespace

TEST_CASE("overlap is the intersection over the union") {
  CHECK(overlap({0, 0, 2, 2}, {1, 0, 3, 2}) == Approx(1.0 / 3));
  CHECK(overlap({0, 0, 2, 2}, {0, 0, 2, 2}) == 1.0f);
  CHECK(overlap({0, 0, 2, 2}, {2, 0, 4, 2}) == 0.0f);
  CHECK(overlap({0, 0, 0, 0}, {0, 0, 0, 0}) == 0.0f);
}

TEST_CASE("of boxes of one class that overlap the best stays, other classes do not matter") {
  const Prediction prediction = prediction_of({{50, 50, 0.6f, 0},  // overlaps the next by 18 / 22
                                               {52, 50, 0.9f, 0},
                                               {51, 50, 0, 0.5f},        // another class
                                               {56, 50, 0.8f, 0.1f},     // overlaps the second by 16 / 24
                                               {150, 50, 0.2f, 0.2f}});  // too weak
  const auto found = detect(prediction, selection());
  CHECK(anchors_of(found) == std::vector<int>{1, 3, 2});
  CHECK(found[2].class_idx == 1);
  CHECK(found[0].box_px.left == 42);
  CHECK(found[0].box_px.bottom == 55);
  CHECK(anchors_of(detect(prediction, selection(0.25f, 0.6f))) == std::vector<int>{1, 2});
  CHECK(anchors_of(detect(prediction, {{0.25f, 0.25f}, 0.7f, 2})) == std::vector<int>{1, 3});
}

TEST_CASE("an anchor stands for its best class only, and needs more than that class's confidence") {
  const Prediction prediction = prediction_of({{50, 50, 0.5f, 0.6f}, {150, 50, 0.25f, 0}});
  CHECK(anchors_of(detect(prediction, selection())) == std::vector<int>{0});
  CHECK(anchors_of(detect(prediction, {{0.1f, 0.7f}, 0.7f, 300})) == std::vector<int>{1});
  const float never = std::numeric_limits<float>::infinity();
  CHECK(anchors_of(detect(prediction, {{0.1f, never}, 0.7f, 300})) == std::vector<int>{1});
}

TEST_CASE("scores that are not numbers make no detection") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(detect(prediction_of({{50, 50, nan, nan}}), selection()).empty());
  CHECK(detect(prediction_of({{nan, 50, 0.9f, 0}}), selection()).empty());
  CHECK(detect(prediction_of({{50, std::numeric_limits<float>::infinity(), 0.9f, 0}}), selection()).empty());
  CHECK(detect(prediction_of({}), selection()).empty());
}

TEST_CASE("non-maximum suppression equals its definition on random boxes") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<std::array<float, 4>> columns;
  for (int i = 0; i < 600; ++i)
    columns.push_back({unit(random) * 90, unit(random) * 40, unit(random), unit(random)});
  const Prediction prediction = prediction_of(columns);
  const auto found = detect(prediction, selection(0.3f, 0.4f));
  REQUIRE(found.size() > 20);
  // Definition: an anchor above the confidence is kept exactly if no kept anchor of its class with a higher
  // score overlaps it by more than the limit.
  for (int i = 0; i < 600; ++i) {
    const auto& [x, y, first, second] = columns[static_cast<std::size_t>(i)];
    const Box box{x - 10, y - 5, x + 10, y + 5};
    const int class_idx = second > first ? 1 : 0;
    const float score = std::max(first, second);
    const bool covered = std::ranges::any_of(found, [&](const Detection& other) {
      return other.class_idx == class_idx && other.score > score && overlap(other.box_px, box) > 0.4f;
    });
    const bool kept = std::ranges::find(found, i, &Detection::anchor_idx) != found.end();
    CHECK(kept == (score > 0.3f && !covered));
  }
}

TEST_CASE("classes and confidences are selected by name") {
  const std::vector<std::string> names = {"person", "chair", "dining table"};
  Parameters parameters;
  parameters.classes = {"chair", "person"};
  parameters.class_confidence = {"person=0.1", "dining table=0.9"};
  const Selection selected = select(parameters, names);
  CHECK(selected.confidence[0] == 0.1f);
  CHECK(selected.confidence[1] == 0.25f);
  CHECK(std::isinf(selected.confidence[2]));
  parameters.classes = {"persn"};
  CHECK_THROWS_WITH(select(parameters, names), Contains("no class \"persn\", did you mean \"person\"?"));
  parameters.classes.clear();
  for (const char* wrong :
       {"person", "person=", "person=x", "person=0.5x", "person=2", "person=nan", "=0.5"}) {
    parameters.class_confidence = {wrong};
    CHECK_THROWS_AS(select(parameters, names), sediment::contract::UsageError);
  }
}

TEST_CASE("boxes are decoded as the mean of their bins under a softmax") {
  std::mt19937 random(9);
  std::normal_distribution<float> normal(0, 3);
  const cv::Size input(96, 64);
  const int bins = 5;
  const auto [count, strides] =
      GENERATE(table<int, std::vector<int>>({{126, {8, 16, 32}}, {510, {4, 8, 16, 32}}}));
  RawHead head{cv::Mat(4 * bins, count, CV_32F), cv::Mat(2, count, CV_32F), cv::Mat(3, count, CV_32F)};
  for (const cv::Mat& part : {head.bins, head.logits, head.coefficients})
    for (float& value : cv::Mat_<float>(part)) value = normal(random);
  const cv::Mat decoded = decode(head, input);
  REQUIRE(decoded.size() == cv::Size(count, 9));
  int anchor = 0;
  for (const int stride : strides)
    for (int row = 0; row < input.height / stride; ++row)
      for (int column = 0; column < input.width / stride; ++column, ++anchor) {
        std::array<double, 4> side{};
        for (int s = 0; s < 4; ++s) {
          double sum = 0, weighted = 0;
          for (int bin = 0; bin < bins; ++bin) {
            const double weight = std::exp(static_cast<double>(head.bins.at<float>(s * bins + bin, anchor)));
            sum += weight;
            weighted += weight * bin;
          }
          side[static_cast<std::size_t>(s)] = weighted / sum * stride;
        }
        const double x = (column + 0.5) * stride, y = (row + 0.5) * stride;
        CHECK(decoded.at<float>(0, anchor) == Approx(x + (side[2] - side[0]) / 2).margin(1e-4));
        CHECK(decoded.at<float>(1, anchor) == Approx(y + (side[3] - side[1]) / 2).margin(1e-4));
        CHECK(decoded.at<float>(2, anchor) == Approx(side[0] + side[2]).margin(1e-4));
        CHECK(decoded.at<float>(3, anchor) == Approx(side[1] + side[3]).margin(1e-4));
        CHECK(decoded.at<float>(5, anchor) == Approx(1 / (1 + std::exp(-head.logits.at<float>(1, anchor)))));
        CHECK(decoded.at<float>(8, anchor) == head.coefficients.at<float>(2, anchor));
      }
  CHECK_THROWS_WITH(decode(head, {96, 96}), Contains("expected 189 anchors"));
}
