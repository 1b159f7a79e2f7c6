#include "pipeline/scene/camera.hpp"

#include <catch2/catch.hpp>
#include <opencv2/calib3d.hpp>

using namespace sediment;

namespace {

const Camera kFreiburg1{640, 480, 517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633},
                        5000};
const Camera kFreiburg2{640, 480, 520.9, 521.0, 325.1, 249.7, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172},
                        5000};
const Camera kFreiburg3{640, 480, 535.4, 539.2, 320.1, 247.6, {}, 5000};

cv::Matx33d matrix_of(const Camera& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

}  // namespace

TEST_CASE("a point is seen where OpenCV's lens model says") {
  const Camera camera = GENERATE(kFreiburg1, kFreiburg2, kFreiburg3);
  for (double x = -1.1; x < 1.1; x += 0.2)
    for (double y = -0.8; y < 0.8; y += 0.2) {
      std::vector<cv::Point2d> expected;
      cv::projectPoints(std::vector<cv::Point3d>{{x, y, 2.0}}, cv::Vec3d(), cv::Vec3d(), matrix_of(camera),
                        cv::Mat(camera.distortion), expected);
      const Pixel seen = camera.project({x, y, 2.0});
      REQUIRE(seen.u == Approx(expected[0].x).margin(1e-9));
      REQUIRE(seen.v == Approx(expected[0].y).margin(1e-9));
    }
}

TEST_CASE("every pixel of the benchmark's lenses goes to a ray and back, corners included") {
  const Camera camera = GENERATE(kFreiburg1, kFreiburg2, kFreiburg3);
  double worst_px = 0;
  for (int v = 0; v < camera.height; v += 7)
    for (int u = 0; u < camera.width; u += 7) {
      const Vec3 point = camera.back_project({double(u), double(v)}, 3.0);
      REQUIRE(point.z == 3.0);
      const Pixel seen = camera.project(point);
      worst_px = std::max({worst_px, std::abs(seen.u - u), std::abs(seen.v - v)});
    }
  CHECK(worst_px < 1e-6);
}

TEST_CASE("the table of rays is the undistortion of every pixel") {
  Camera camera = kFreiburg1;
  camera.width = 40;
  camera.height = 30;
  const auto rays = rays_of(camera);
  REQUIRE(rays.size() == 1200);
  const Pixel ray = camera.undistort({13, 29});
  CHECK(rays[29 * 40 + 13].x == static_cast<float>(ray.u));
  CHECK(rays[29 * 40 + 13].y == static_cast<float>(ray.v));
}

TEST_CASE("without a lens the back-projection is equation 4 of the paper") {
  const Vec3 point = kFreiburg3.back_project({100, 400}, 1.5);
  CHECK(point.x == Approx((100 - 320.1) * 1.5 / 535.4).epsilon(1e-15));
  CHECK(point.y == Approx((400 - 247.6) * 1.5 / 539.2).epsilon(1e-15));
  CHECK_FALSE(kFreiburg3.has_distortion());
  CHECK(kFreiburg1.has_distortion());
}
