#include "tools/synthesize/depth_sensor.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tools/synthesize/recording.hpp"

using namespace sediment;
using namespace sediment::synthetic;

namespace {

const Camera kCamera = camera_for(640, 480);

/// Depth of a plane that slants by `slope` over the image: no two columns have the same phase of the steps.
cv::Mat slanted_plane(double depth_m, double slope) {
  cv::Mat plane(kCamera.height, kCamera.width, CV_32FC1);
  for (int v = 0; v < plane.rows; ++v)
    for (int u = 0; u < plane.cols; ++u)
      plane.at<float>(v, u) = static_cast<float>(depth_m * (1 + slope * (u - 320) / 640));
  return plane;
}

cv::Mat no_loss() {
  return cv::Mat(kCamera.height, kCamera.width, CV_32FC1, cv::Scalar(0));
}

struct Errors {
  double mean = 0, deviation = 0;
  int count = 0;
};
Errors errors_of(const cv::Mat& measured, const cv::Mat& exact) {
  Errors e;
  double sum = 0, squares = 0;
  for (int v = 0; v < exact.rows; ++v)
    for (int u = 0; u < exact.cols; ++u)
      if (const int units = measured.at<std::uint16_t>(v, u)) {
        const double error = units / kCamera.depth_scale - exact.at<float>(v, u);
        sum += error, squares += error * error, ++e.count;
      }
  e.mean = sum / e.count;
  e.deviation = std::sqrt(squares / e.count - e.mean * e.mean);
  return e;
}

}  // namespace

TEST_CASE("depth noise grows with the square of the depth as the model says, without bias") {
  const DepthSensor sensor;
  for (const double depth_m : {0.8, 1.5, 2.5, 3.5}) {
    const cv::Mat exact = slanted_plane(depth_m, 0.08);
    const Errors e = errors_of(measure_depth(exact, no_loss(), kCamera, sensor, 7), exact);
    // The steps of the file (0.2 mm) add a little close by.
    const double disparity_px =
        std::sqrt(sensor.noise_px * sensor.noise_px + sensor.step_px * sensor.step_px / 12);
    const double model =
        std::hypot(depth_m * depth_m / sensor.disparity_m_px * disparity_px, 0.0002 / std::sqrt(12));
    INFO("depth " << depth_m << " deviation " << e.deviation << " model " << model);
    CHECK(e.count == 640 * 480);
    CHECK(e.deviation == Approx(model).epsilon(0.04));
    CHECK(std::abs(e.mean) < 0.1 * model);
  }
}

TEST_CASE("measured disparities are whole steps") {
  const DepthSensor sensor;
  const cv::Mat measured = measure_depth(slanted_plane(2, 0.1), no_loss(), kCamera, sensor, 1);
  for (int u = 0; u < 640; u += 7) {
    const double steps =
        sensor.disparity_m_px / (measured.at<std::uint16_t>(100, u) / kCamera.depth_scale) / sensor.step_px;
    CHECK(std::abs(steps - std::round(steps)) < 0.01);
  }
}

TEST_CASE("there is no depth out of range, where light is blocked and at edges there is less") {
  cv::Mat exact = slanted_plane(3, 0);
  exact(cv::Rect(200, 100, 100, 200)).setTo(1.0);  // a thing in front of the wall
  exact(cv::Rect(500, 0, 20, 480)).setTo(0.3);     // too near
  exact(cv::Rect(560, 0, 20, 480)).setTo(6.0);     // too far
  const cv::Mat measured = measure_depth(exact, no_loss(), kCamera, {}, 3);
  const auto valid = [&](cv::Rect area) {
    return cv::countNonZero(measured(area)) / static_cast<double>(area.area());
  };
  CHECK(valid({502, 0, 16, 480}) == 0);
  CHECK(valid({562, 0, 16, 480}) == 0);
  CHECK(valid({20, 20, 100, 400}) == 1);
  CHECK(valid({203, 103, 94, 194}) == 1);
  // Shadow of the baseline: 40.2 / 1 - 40.2 / 3 = 26.8 pixels to the right of the thing.
  CHECK(valid({302, 105, 23, 190}) == 0);
  CHECK(valid({330, 105, 60, 190}) == 1);
  const double left_edge = valid({198, 105, 4, 190});
  CHECK(left_edge > 0.3);
  CHECK(left_edge < 0.9);
}

TEST_CASE("at grazing angles depth is lost, at moderate ones not") {
  // Rows see a floor: z = h * fy / (v - horizon); the slant there is z / h.
  cv::Mat floor(480, 640, CV_32FC1, cv::Scalar(0));
  for (int v = 20; v < 480; ++v) floor.row(v).setTo(std::min(5.0, 0.3 * kCamera.fy / v));
  const cv::Mat measured = measure_depth(floor, no_loss(), kCamera, {}, 3);
  const auto valid_row = [&](double z) {
    return cv::countNonZero(measured.row(static_cast<int>(0.3 * kCamera.fy / z))) / 640.0;
  };
  CHECK(valid_row(1.0) == 1);
  CHECK(valid_row(2.2) < 0.8);
  CHECK(valid_row(3.4) < 0.05);
}

TEST_CASE("noise is the same for the same seed and other for another") {
  const cv::Mat exact = slanted_plane(2, 0.1);
  const cv::Mat a = measure_depth(exact, no_loss(), kCamera, {}, 1),
                b = measure_depth(exact, no_loss(), kCamera, {}, 1);
  CHECK(cv::norm(a, b, cv::NORM_INF) == 0);
  CHECK(cv::countNonZero(a != measure_depth(exact, no_loss(), kCamera, {}, 2)) > 100000);
}
