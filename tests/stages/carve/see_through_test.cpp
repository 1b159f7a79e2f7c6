#include "stages/carve/see_through.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace sediment;
using namespace sediment::carve;

namespace {

Camera small_camera() {
  Camera camera;
  camera.width = 64, camera.height = 48;
  camera.fx = camera.fy = 50;
  camera.cx = 31.5, camera.cy = 23.5;
  return camera;
}

/// A wall across the optical axis.
cv::Mat wall_at(double depth_m) {
  return cv::Mat(48, 64, CV_16UC1, cv::Scalar(depth_m * 5000));
}

LabelledPoint at(double x, double y, double z) {
  LabelledPoint p;
  p.x = static_cast<float>(x), p.y = static_cast<float>(y), p.z = static_cast<float>(z);
  return p;
}

Votes votes_of(const LabelledPoint& point, const DepthView& view, const Camera& camera = small_camera(),
               const Parameters& parameters = {}) {
  std::vector<Votes> votes(1);
  add_votes({point}, camera, view, parameters, votes);
  return votes[0];
}

}  // namespace

TEST_CASE(
    "a view sees through what floats before a wall, sees the wall, and says nothing of what is behind it") {
  const DepthView view{{}, wall_at(3), {}};
  const Votes before = votes_of(at(0, 0, 1.5), view), on = votes_of(at(0.1, 0.1, 3.0), view),
              behind = votes_of(at(0, 0, 4), view);
  CHECK((before.through == 1 && before.hits == 0));
  CHECK((on.through == 0 && on.hits == 1));
  CHECK((behind.through == 0 && behind.hits == 0));
}

TEST_CASE("the tolerance is the slack and some deviations of the noise at the measured depth") {
  const DepthView view{{}, wall_at(3), {}};
  // 0.02 + 4 * 0.0014 * 3^2 = 0.0704 m.
  CHECK(votes_of(at(0, 0, 3 - 0.069), view).through == 0);
  CHECK(votes_of(at(0, 0, 3 - 0.069), view).hits == 1);
  CHECK(votes_of(at(0, 0, 3 - 0.072), view).through == 1);
}

TEST_CASE(
    "outside of the picture and of the range, behind the camera and without coordinates nothing is said") {
  const DepthView view{{}, wall_at(3), {}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const LabelledPoint& p : {at(5, 0, 1.5), at(0, -5, 1.5), at(0, 0, -1), at(0, 0, 0.1), at(0, 0, 6),
                                 at(0, 0, 0), at(nan, 0, 1.5), at(0, 0, nan)}) {
    const Votes votes = votes_of(p, view);
    CHECK((votes.through == 0 && votes.hits == 0));
  }
}

TEST_CASE("a point is safe where the sensor is silent, at an edge and on a surface seen at a grazing angle") {
  DepthView silent{{}, wall_at(3), {}};
  silent.depth.at<std::uint16_t>(24, 33) = 0;
  CHECK(votes_of(at(0, 0, 1.5), silent).through == 0);

  DepthView edge{{}, wall_at(3), {}};
  edge.depth.colRange(0, 31).setTo(1.5 *
                                   5000);  // a box whose border is two pixels from the image of the point
  CHECK(votes_of(at(0, 0, 1.5), edge).through == 0);
  CHECK(votes_of(at(0.5, 0, 1.5), edge).through == 1);

  // A floor half a metre below the camera: y = 0.5, depth 0.5 * fy / (v - cy).
  DepthView floor{{}, cv::Mat::zeros(48, 64, CV_16UC1), {}};
  const Camera camera = small_camera();
  for (int v = 28; v < 48; ++v) floor.depth.row(v).setTo(0.5 * camera.fy / (v - camera.cy) * 5000);
  for (const double z : {1.1, 1.5, 2.0, 3.0, 4.0}) CHECK(votes_of(at(0.2, 0.5, z), floor).through == 0);
}

TEST_CASE("dynamic pixels clear what is before them but do not hold what is at their depth") {
  DepthView view{{}, wall_at(2), cv::Mat(48, 64, CV_8UC1, cv::Scalar(1))};
  CHECK(votes_of(at(0, 0, 1), view).through == 1);
  CHECK(votes_of(at(0, 0, 2), view).hits == 0);
}

TEST_CASE("the lens is taken into account") {
  Camera camera = small_camera();
  camera.distortion = {0.3, 0, 0, 0, 0};
  const LabelledPoint point = at(0.5, 0.3, 1.5);
  const Pixel bent = camera.project({0.5, 0.3, 1.5});
  REQUIRE(bent.u > small_camera().project({0.5, 0.3, 1.5}).u + 0.4);
  DepthView view{{}, wall_at(3), {}};
  Parameters exact;
  exact.window_px = 0;
  view.depth.at<std::uint16_t>(static_cast<int>(std::lround(bent.v)), static_cast<int>(std::lround(bent.u))) =
      7500;
  CHECK(votes_of(point, view, camera, exact).hits == 1);
}

TEST_CASE("a pose moves the look") {
  DepthView view{
      Pose{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, -10}}, wall_at(3), {}};  // the camera stands at z = 10
  CHECK(votes_of(at(0, 0, 11.5), view).through == 1);
  CHECK(votes_of(at(0, 0, 1.5), view).through == 0);
}

TEST_CASE("a point goes if enough views, and most of those that say something, see through it") {
  const Parameters parameters;  // three views, more than a half
  CHECK_FALSE(is_carved({0, 0}, parameters));
  CHECK_FALSE(is_carved({2, 0}, parameters));
  CHECK(is_carved({3, 0}, parameters));
  CHECK(is_carved({10, 9}, parameters));
  CHECK_FALSE(is_carved({10, 10}, parameters));
  CHECK_FALSE(is_carved({10, 90}, parameters));
}

TEST_CASE("votes do not depend on the number of threads") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> along(-2, 5);
  LabelledCloud cloud;
  for (int i = 0; i < 50000; ++i) cloud.push_back(at(along(random), along(random), along(random)));
  std::vector<std::vector<Votes>> results;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<Votes>& votes = results.emplace_back(cloud.size());
    add_votes(cloud, small_camera(), {{}, wall_at(3), {}}, {}, votes);
  }
  const auto same = [](const Votes& a, const Votes& b) { return a.through == b.through && a.hits == b.hits; };
  CHECK(std::equal(results[0].begin(), results[0].end(), results[1].begin(), same));
}
