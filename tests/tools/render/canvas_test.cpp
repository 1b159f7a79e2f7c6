#include "tools/render/canvas.hpp"

#include <catch2/catch.hpp>

using namespace sediment;
using namespace sediment::render;

namespace {

const cv::Vec3b kRed{0, 0, 255}, kBlue{255, 0, 0};

View parallel(int width, int height, double px_per_metre) {
  return {{}, false, px_per_metre, {width, height}};
}

}  // namespace

TEST_CASE("the nearer disc hides the other one, whichever is drawn first") {
  for (const bool near_first : {true, false}) {
    Canvas canvas(parallel(64, 64, 10));
    if (near_first) canvas.disc({0, 0, 1}, 1, kRed);
    canvas.disc({0, 0, 2}, 2, kBlue);
    if (!near_first) canvas.disc({0, 0, 1}, 1, kRed);
    const cv::Mat picture = canvas.shaded(0);
    CHECK(picture.at<cv::Vec3b>(32, 32) == kRed);
    CHECK(picture.at<cv::Vec3b>(32, 32 + 15) == kBlue);
    CHECK(picture.at<cv::Vec3b>(2, 2) == kPaper);
  }
}

TEST_CASE("a cube covers its square, its top is brighter than its sides") {
  const Vec3 up{0, 0, -1};  // the camera looks down
  Canvas canvas(parallel(64, 64, 10));
  canvas.cube({0, 0, 5}, 2, kBlue, up);
  const cv::Mat picture = canvas.shaded(0);
  int covered = 0;
  for (int v = 0; v < 64; ++v)
    for (int u = 0; u < 64; ++u) covered += picture.at<cv::Vec3b>(v, u) != kPaper ? 1 : 0;
  CHECK(covered == Approx(400).margin(45));  // 20 x 20 pixels and a seam
  CHECK(picture.at<cv::Vec3b>(32, 32)[0] > 240);

  View from_the_side = parallel(64, 64, 10);
  from_the_side.view_from_world = {{1, 0, 0, 0, 0, 1, 0, -1, 0}, {0, 0, 0}};
  Canvas side(from_the_side);
  side.cube({0, 0, 0}, 2, kBlue, up);
  const int brightness = side.shaded(0).at<cv::Vec3b>(32, 32)[0];
  CHECK(brightness < 230);
  CHECK(brightness > 100);
}

TEST_CASE("lighting darkens the far side of a step and leaves a plane alone") {
  Canvas canvas(parallel(64, 64, 10));
  for (double x = -3; x < 3; x += 0.05)
    for (double y = -3; y < 3; y += 0.05) canvas.disc({x, y, x < 0 ? 2.0 : 1.0}, 0.1, {200, 200, 200});
  const cv::Mat picture = canvas.shaded(2);
  CHECK(static_cast<int>(picture.at<cv::Vec3b>(32, 10)[0]) == 200);
  CHECK(static_cast<int>(picture.at<cv::Vec3b>(32, 50)[0]) == 200);
  CHECK(static_cast<int>(picture.at<cv::Vec3b>(32, 30)[0]) < 170);
}

TEST_CASE("points behind the camera and far outside draw nothing") {
  View view;
  view.size = {64, 64};
  Canvas canvas(view);
  canvas.disc({0, 0, -1}, 1, kRed);
  canvas.disc({1e6, 0, 1}, 0.1, kRed);
  canvas.cube({0, 0, -3}, 1, kRed, {0, 0, 1});
  canvas.cube({0, -1e7, 3}, 1, kRed, {0, 0, 1});
  const cv::Mat picture = canvas.shaded(1);
  CHECK(cv::countNonZero(picture.reshape(1) != kPaper[0]) == 0);
}
