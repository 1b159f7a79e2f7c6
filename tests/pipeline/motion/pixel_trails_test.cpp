#include "pipeline/motion/pixel_trails.hpp"

#include <catch2/catch.hpp>

using namespace sediment;

namespace {

constexpr double kScale = 5000;

FlowField uniform(float dx, float dy) {
  return {cv::Mat(24, 32, CV_32FC2, cv::Scalar(dx, dy)), {64, 48}};
}
cv::Mat flat(int units) {
  return cv::Mat(48, 64, CV_16UC1, cv::Scalar(units));
}

}  // namespace

TEST_CASE("trails start in the middle of their squares and are valid") {
  const PixelTrails trails = start_trails(flat(5000), 4);
  CHECK(trails.columns == 16);
  CHECK(trails.rows == 12);
  REQUIRE(trails.size() == 192);
  CHECK(trails.u[1] == 6);
  CHECK(trails.v[16] == 6);
  CHECK(trails.depth[5] == 5000);
  CHECK(std::count(trails.valid.begin(), trails.valid.end(), 1) == 192);
}

TEST_CASE("a trail follows the flow and ends at the border of the image") {
  PixelTrails trails = start_trails(flat(5000), 4);
  follow(trails, uniform(5, 0), uniform(-5, 0), flat(5000), kScale, {});
  follow(trails, uniform(5, 1), uniform(-5, -1), flat(5000), kScale, {});
  CHECK(trails.u[0] == Approx(12));
  CHECK(trails.v[0] == Approx(3));
  CHECK(trails.valid[0] == 1);
  CHECK(trails.trust[0] == 1);
  CHECK(trails.valid[15] == 0);  // began at 62
  CHECK(trails.valid[13] == 0);  // began at 54: 64 is outside
  CHECK(trails.valid[12] == 1);  // began at 50
}

TEST_CASE("a trail ends where the depth jumps, not where it is missing or changes a little") {
  PixelTrails trails = start_trails(flat(5000), 4);
  follow(trails, uniform(0, 0), uniform(0, 0), flat(0), kScale, {});
  CHECK(trails.valid[0] == 1);
  follow(trails, uniform(0, 0), uniform(0, 0), flat(5700), kScale, {});
  CHECK(trails.valid[0] == 1);  // 14 cm at 1 m: within 10 cm + 5 %
  follow(trails, uniform(0, 0), uniform(0, 0), flat(6600), kScale, {});
  CHECK(trails.valid[0] == 0);  // 18 cm
}

TEST_CASE("a trail loses trust where the reverse flow does not lead back") {
  PixelTrails trails = start_trails(flat(5000), 4);
  follow(trails, uniform(6, 0), uniform(0, 0), flat(5000), kScale, {});
  CHECK(trails.valid[0] == 1);
  CHECK(trails.trust[0] < 0.5F);
}
