#include <catch2/catch.hpp>

#include "stages/segment/network/letterbox.hpp"

using namespace sediment::segment;

TEST_CASE("an image is scaled and centred as Ultralytics does") {
  // Expected values: LetterBox of ultralytics 8, by hand.
  const Letterbox tall = fit({810, 1080}, {640, 640});
  CHECK(tall.scaled == cv::Size(480, 640));
  CHECK(tall.left == 80);
  CHECK(tall.top == 0);
  CHECK(tall.scale == Approx(640.0 / 1080));
  const Letterbox camera = fit({640, 480}, {320, 320});
  CHECK(camera.scaled == cv::Size(320, 240));
  CHECK(camera.top == 40);
  // 427 * 640 / 640: an odd border, 213 / 2 = 106.5, has its extra pixel below.
  const Letterbox odd = fit({640, 427}, {640, 640});
  CHECK(odd.scaled == cv::Size(640, 427));
  CHECK(odd.top == 106);
  CHECK(fit({640, 480}, {640, 480}).scaled == cv::Size(640, 480));
}

TEST_CASE("a dynamic network gets the smallest input of whole strides") {
  CHECK(smallest_input({640, 480}, 640, 32) == cv::Size(640, 480));
  CHECK(smallest_input({810, 1080}, 640, 32) == cv::Size(480, 640));
  CHECK(smallest_input({1280, 720}, 640, 32) == cv::Size(640, 384));  // 360 is no multiple of 32
  CHECK(smallest_input({640, 480}, 320, 32) == cv::Size(320, 256));   // 240 neither
}

TEST_CASE("the input has RGB planes in 0 .. 1 and a border of 114") {
  cv::Mat image(2, 4, CV_8UC3, cv::Scalar(51, 102, 255));
  image.at<cv::Vec3b>(1, 3) = {0, 0, 0};
  const Letterbox box = fit(image.size(), {4, 5});
  CHECK(box.top == 1);
  const cv::Mat input = to_input(image, box);
  REQUIRE(input.dims == 4);
  CHECK(input.size[1] == 3);
  CHECK(input.size[2] == 5);
  CHECK(input.size[3] == 4);
  const auto at = [&](int channel, int y, int x) { return input.ptr<float>(0, channel)[y * 4 + x]; };
  CHECK(at(0, 1, 0) == 1.0f);
  CHECK(at(1, 1, 0) == 102 / 255.0f);
  CHECK(at(2, 2, 2) == 51 / 255.0f);
  CHECK(at(0, 2, 3) == 0.0f);
  for (const int y : {0, 3, 4})
    for (int x = 0; x < 4; ++x) CHECK(at(1, y, x) == 114 / 255.0f);
  CHECK_THROWS_AS(to_input(cv::Mat::zeros(2, 5, CV_8UC3), box), std::invalid_argument);
}
