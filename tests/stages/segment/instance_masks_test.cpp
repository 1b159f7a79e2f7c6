#include <catch2/catch.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "stages/segment/instance_masks.hpp"

using namespace sediment;
using namespace sediment::segment;

namespace {

constexpr int kCoefficients = 4;

/// Smooth random prototypes of 40 x 30 for an input of 160 x 120, one anchor per detection.
Prediction random_prediction(int detections, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, 2);
  Prediction prediction;
  prediction.mask_size = {40, 30};
  prediction.prototypes = cv::Mat(kCoefficients, 1200, CV_32F);
  for (float& value : cv::Mat_<float>(prediction.prototypes)) value = normal(random);
  for (int k = 0; k < kCoefficients; ++k) {
    cv::Mat plane(30, 40, CV_32F, prediction.prototypes.ptr<float>(k));
    cv::GaussianBlur(plane, plane, {}, 2);
  }
  prediction.anchors = cv::Mat(4 + 1 + kCoefficients, detections, CV_32F);
  for (float& value : cv::Mat_<float>(prediction.anchors)) value = normal(random);
  return prediction;
}

/// The whole mask as its definition says it: all probabilities, enlarged by OpenCV.
cv::Mat mask_by_definition(const Prediction& prediction, int anchor_idx, cv::Size input) {
  cv::Mat coefficients = prediction.anchors.col(anchor_idx).rowRange(5, 5 + kCoefficients).t();
  cv::Mat probability = cv::Mat(coefficients * prediction.prototypes).reshape(1, 30), enlarged;
  for (float& value : cv::Mat_<float>(probability)) value = 1 / (1 + std::exp(-value));
  cv::resize(probability, enlarged, input, 0, 0, cv::INTER_LINEAR);
  return enlarged > 0.5;
}

ObjectMask object(std::string class_name, double score, const cv::Rect& window, int value = 255) {
  return {std::move(class_name), score, {}, window, cv::Mat(window.size(), CV_8UC1, cv::Scalar(value))};
}

}  // namespace

TEST_CASE("masks assembled inside boxes equal whole masks that are cropped") {
  const cv::Size image(160, 120);
  const Letterbox letterbox = fit(image, image);
  const Prediction prediction = random_prediction(50, 1);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> x(-20, 180), y(-20, 140);
  int compared = 0;
  for (int i = 0; i < 50; ++i) {
    const float a = x(random), b = x(random), c = y(random), d = y(random);
    const Box box{std::min(a, b), std::min(c, d), std::max(a, b), std::max(c, d)};
    const auto objects = assemble(prediction, {{0, 0.5f, box, i}}, letterbox, {"thing"});
    const cv::Rect window = cv::Rect(cv::Point(cvRound(box.left), cvRound(box.top)),
                                     cv::Point(cvRound(box.right), cvRound(box.bottom))) &
                            cv::Rect({}, image);
    const cv::Mat expected = mask_by_definition(prediction, i, image)(window);
    if (window.empty() || cv::countNonZero(expected) == 0) {
      CHECK(objects.empty());
      continue;
    }
    ++compared;
    REQUIRE(objects.size() == 1);
    CHECK(objects[0].window == window);
    CHECK(cv::countNonZero(objects[0].pixels != expected) == 0);
  }
  CHECK(compared > 25);
}

TEST_CASE("a box over the whole image and beyond is clipped to it") {
  const cv::Size image(160, 120);
  Prediction prediction = random_prediction(1, 1);
  prediction.prototypes = 1.0f;
  prediction.anchors = 1.0f;
  const auto objects =
      assemble(prediction, {{0, 0.5f, {-50, -50, 500, 500}, 0}}, fit(image, image), {"thing"});
  CHECK(assemble(prediction, {{0, 0.5f, {-1e30f, -1e30f, 1e30f, 1e30f}, 0}}, fit(image, image), {"thing"})
            .size() == 1);
  REQUIRE(objects.size() == 1);
  CHECK(objects[0].box_px == std::array<double, 4>{0, 0, 160, 120});
  CHECK(cv::countNonZero(objects[0].pixels) == 160 * 120);
  const InstanceMask mask = paint(objects, image);
  CHECK(cv::countNonZero(mask.ids == 1) == 160 * 120);
}

TEST_CASE("where objects overlap the one with the higher score has the pixel") {
  const cv::Rect left(0, 0, 10, 10), right(5, 0, 10, 10);
  const InstanceMask mask = paint({object("chair", 0.5, left), object("person", 0.9, right)}, {20, 10});
  REQUIRE(mask.instances.size() == 2);
  CHECK(mask.instances[0].id == 1);
  CHECK(mask.instances[0].class_name == "person");
  CHECK(mask.instances[1].id == 2);
  CHECK(cv::countNonZero(mask.ids == 1) == 100);
  CHECK(cv::countNonZero(mask.ids == 2) == 50);
  const InstanceMask equal = paint({object("chair", 0.5, left), object("person", 0.5, right)}, {20, 10});
  CHECK(equal.instances[0].class_name == "chair");
}

TEST_CASE("an object that is covered whole is left out, and ids have no gaps") {
  const InstanceMask mask = paint({object("person", 0.9, {0, 0, 10, 10}), object("tie", 0.8, {2, 2, 3, 3}),
                                   object("chair", 0.7, {5, 5, 10, 5})},
                                  {20, 10});
  REQUIRE(mask.instances.size() == 2);
  CHECK(mask.instances[1].class_name == "chair");
  CHECK(mask.instances[1].id == 2);
  CHECK(mask.ids.at<std::uint16_t>(3, 3) == 1);
}

TEST_CASE("a hundred objects are painted, and none") {
  std::vector<ObjectMask> objects;
  for (int i = 0; i < 100; ++i)
    objects.push_back(object("person", 1 - i * 0.001, {i % 10 * 8, i / 10 * 8, 12, 12}));
  const InstanceMask mask = paint(objects, {90, 90});
  CHECK(mask.instances.size() == 100);
  CHECK(cv::countNonZero(mask.ids == 100) > 0);
  CHECK(paint({}, {90, 90}).instances.empty());
  CHECK(cv::countNonZero(paint({}, {90, 90}).ids) == 0);
}
