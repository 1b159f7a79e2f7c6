#include "stages/fuse/back_projection.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

using namespace sediment;
using namespace sediment::fuse;

namespace {

const LabelTable kLabels({{56, "chair", {255, 0, 0}, false}, {73, "book", {0, 0, 255}, false}});

Camera small_camera() {
  return {64, 48, 60, 61, 31.5, 23.5, {}, 5000};
}

/// Everything two metres away, grey.
View flat_view() {
  return {cv::Mat(48, 64, CV_8UC3, cv::Scalar(100, 110, 120)),
          cv::Mat(48, 64, CV_16UC1, cv::Scalar(10000)),
          {},
          {},
          {}};
}

LabelledCloud fused(const View& view, const Camera& camera, const Projection& projection,
                    PixelCounts* counts = nullptr) {
  LabelledCloud cloud;
  const auto rays = rays_of(camera);
  const PixelCounts counted = back_project(view, camera, rays, kLabels, projection, cloud);
  if (counts) *counts = counted;
  return cloud;
}

}  // namespace

TEST_CASE("a fused point projects back onto its pixel and depth, whatever the pose and the lens") {
  Camera camera = small_camera();
  camera.distortion =
      GENERATE(std::array<double, 5>{}, std::array<double, 5>{0.26, -0.95, -0.005, 0.003, 1.16});
  View view = flat_view();
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u)
      view.depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(5000 + 200 * v + 17 * u);
  view.world_from_camera = pose_from({0.3, -0.2, 0.5, 0.7}, {4, -2, 1.5});
  const LabelledCloud cloud = fused(view, camera, {.pixel_step = 1});
  REQUIRE(cloud.size() == 64 * 48);
  const Pose camera_from_world = view.world_from_camera.inverse();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 point = camera_from_world * Vec3{cloud[i].x, cloud[i].y, cloud[i].z};
    const Pixel pixel = camera.project(point);
    const int u = static_cast<int>(i % 64), v = static_cast<int>(i / 64);
    INFO("pixel " << u << " " << v);
    REQUIRE(point.z == Approx(view.depth.at<std::uint16_t>(v, u) / 5000.0).margin(2e-6));
    REQUIRE(std::hypot(pixel.u - u, pixel.v - v) < 1e-3);
  }
}

TEST_CASE("dynamic pixels stay out, of both kinds") {
  View view = flat_view();
  view.dynamic = cv::Mat(48, 64, CV_8UC1, cv::Scalar(kStatic));
  view.dynamic(cv::Rect(0, 0, 64, 10)) = kPriorDynamic;
  view.dynamic(cv::Rect(0, 40, 64, 8)) = kNonPriorDynamic;
  PixelCounts counts;
  const LabelledCloud cloud = fused(view, small_camera(), {.pixel_step = 1}, &counts);
  CHECK(cloud.size() == 64 * 30);
  CHECK(counts.visited == 64 * 48);
  CHECK(counts.dynamic == 64 * 18);
  for (const LabelledPoint& point : cloud) REQUIRE(std::abs(point.y) < 2 * 16.6 / 61);
}

TEST_CASE("pixels without depth, too near or too far stay out; the limits themselves belong to the range") {
  View view = flat_view();
  auto* first = view.depth.ptr<std::uint16_t>(0);
  first[0] = 0;
  first[1] = 4999;
  first[2] = 5000;
  first[3] = 15000;
  first[4] = 15001;
  first[5] = 65535;
  PixelCounts counts;
  const LabelledCloud cloud =
      fused(view, small_camera(), {.min_depth_m = 1, .max_depth_m = 3, .pixel_step = 1}, &counts);
  CHECK(cloud.size() == 64 * 48 - 4);
  CHECK(counts.out_of_range == 4);
  CHECK(cloud[0].z == 1);
  CHECK(cloud[1].z == 3);

  view.depth = 0;
  CHECK(fused(view, small_camera(), {.min_depth_m = 0}).empty());
}

TEST_CASE(
    "pixels at a step of the depth and on grazing surfaces stay out when asked for, slopes and noise stay") {
  const Camera camera = small_camera();
  View view = flat_view();
  const auto points = [&](double max_incidence_deg) {
    return fused(view, camera, {.pixel_step = 1, .max_incidence_deg = max_incidence_deg}).size();
  };
  const std::size_t all = points(90);
  CHECK(points(80) == all);
  // A box nearer by half a metre, 4 x 3 pixels: its rim (10) and the 14 pixels beside it.
  const auto rows = view.depth.rows, cols = view.depth.cols;
  view.depth(cv::Rect(5, 5, 4, 3)) = cv::Scalar(view.depth.at<std::uint16_t>(0, 0) - 2500);
  CHECK(points(90) == all);
  CHECK(points(80) == all - 10 - 14);
  // A plane whose depth grows by a share of itself with every column: tan(angle) = share * fx.
  const auto slanted = [&](double angle_deg) {
    const double share = std::tan(angle_deg * 3.14159265358979 / 180) / camera.fx;
    double z = 1;
    for (int u = 0; u < cols; ++u, z *= 1 + share)
      view.depth.col(u) = cv::Scalar(std::round(z * camera.depth_scale));
    return points(60);
  };
  const std::size_t whole = static_cast<std::size_t>(rows * cols);
  CHECK(slanted(40) == whole);
  CHECK(slanted(75) < whole / 10);
}

TEST_CASE("the pixel step takes every n-th pixel of every n-th row, from the first") {
  const LabelledCloud cloud = fused(flat_view(), small_camera(), {.pixel_step = 5});
  CHECK(cloud.size() == 13 * 10);
  CHECK(cloud[0].x == Approx(2 * (0 - 31.5) / 60));
  CHECK(cloud[1].x == Approx(2 * (5 - 31.5) / 60));
}

TEST_CASE("a labelled point has its class, instance and half its class colour") {
  View view = flat_view();
  view.mask = {cv::Mat(48, 64, CV_16UC1, cv::Scalar(0)), {{7, "chair"}, {9, "spoon of an unknown kind"}}};
  view.mask.ids.at<std::uint16_t>(0, 1) = 7;
  view.mask.ids.at<std::uint16_t>(0, 2) = 9;
  const LabelledCloud cloud = fused(view, small_camera(), {.pixel_step = 1, .blend = 0.5});
  const auto bgr = [&](std::size_t i) { return std::array<int, 3>{cloud[i].b, cloud[i].g, cloud[i].r}; };
  CHECK(cloud[0].label == kUnlabelled);
  CHECK(cloud[0].instance == 0);
  CHECK(bgr(0) == std::array{100, 110, 120});
  CHECK(cloud[1].label == 56);
  CHECK(cloud[1].instance == 7);
  CHECK(bgr(1) == std::array{50, 55, 188});
  CHECK(cloud[2].label == kUnlabelled);
  CHECK(cloud[2].instance == 9);
  CHECK(bgr(2) == std::array{100, 110, 120});
  CHECK(fused(view, small_camera(), {.pixel_step = 1, .blend = 1})[1].r == 255);
  CHECK(fused(view, small_camera(), {.pixel_step = 1, .blend = 0})[1].r == 120);
}

TEST_CASE("an image of another size than the camera's is refused and named") {
  View view = flat_view();
  view.dynamic = cv::Mat(24, 32, CV_8UC1, cv::Scalar(0));
  CHECK_THROWS_WITH(fused(view, small_camera(), {}), "the dynamic mask is 32x24, the camera 64x48");
  view = flat_view();
  view.mask.ids = cv::Mat(1, 1, CV_16UC1, cv::Scalar(0));
  CHECK_THROWS_AS(fused(view, small_camera(), {}), std::invalid_argument);
}
