#include "stages/carve/see_through.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
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
  add_votes(blocks_of({point}), camera, view, parameters, votes);
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
  // Hits and views that show something behind the point in its very pixel, amid an edge: one in five.
  CHECK_FALSE(is_carved({.hits = 20, .behind = 80}, parameters));
  CHECK(is_carved({.hits = 19, .behind = 81}, parameters));
  CHECK(is_carved({.behind = 3}, parameters));
  CHECK_FALSE(is_carved({.behind = 2}, parameters));
}

TEST_CASE("a point settles where the views have it in the mean, the exact ones counting most") {
  const Parameters parameters{.settle = true};
  const LabelledPoint point = at(0.2, -0.1, 3.03);
  std::vector<Votes> votes(1);
  // Three views from the origin have the wall at 3 m, one from 2 m nearer, more exact by (3 / 1)^2, at 3.02
  // m.
  for (int i = 0; i < 3; ++i)
    add_votes(blocks_of({point}), small_camera(), {{}, wall_at(3), {}}, parameters, votes);
  const Pose nearer{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, -2}};
  add_votes(blocks_of({point}), small_camera(), {nearer, wall_at(1.02), {}}, parameters, votes);
  REQUIRE(votes[0].shown == 4);
  const LabelledPoint there = settled(point, votes[0], parameters);
  const double far = 3 / std::pow(3.0, 4), near = 1 / std::pow(1.02, 4);
  CHECK(there.z == Approx((far * 3.00 + near * 3.02) / (far + near)).margin(2e-5));
  // Along the rays: those of the origin keep x / z.
  CHECK(there.x ==
        Approx(0.2 - (far * 0.2 * 0.03 / 3.03 + near * 0.2 * 0.01 / 1.03) / (far + near)).margin(2e-5));

  std::vector<Votes> few(1);
  for (int i = 0; i < 2; ++i)
    add_votes(blocks_of({point}), small_camera(), {{}, wall_at(3), {}}, parameters, few);
  CHECK(settled(point, few[0], parameters) == point);
  const DepthView moving{{}, wall_at(3), cv::Mat(48, 64, CV_8UC1, cv::Scalar(1))};
  std::vector<Votes> by_movers(1);
  add_votes(blocks_of({point}), small_camera(), moving, parameters, by_movers);
  CHECK(by_movers[0].shown == 0);
}

TEST_CASE("a point goes that more than the share of the frames which show it take for a person") {
  const auto goes = [](int person, int shown, double wall_m = 3, int dynamic = 1) {
    const LabelledPoint point = at(0.2, -0.1, 3);
    std::vector<Votes> votes(1);
    const DepthView taken_for{{}, wall_at(wall_m), cv::Mat(48, 64, CV_8UC1, cv::Scalar(dynamic))};
    for (int i = 0; i < person; ++i) add_votes(blocks_of({point}), small_camera(), taken_for, {}, votes);
    for (int i = 0; i < shown; ++i)
      add_votes(blocks_of({point}), small_camera(), {{}, wall_at(3), {}}, {}, votes);
    return is_carved(votes[0], {});
  };
  CHECK(goes(4, 11));
  CHECK_FALSE(goes(4, 12));
  CHECK_FALSE(goes(2, 0));          // fewer than min_views
  CHECK_FALSE(goes(40, 12, 2));     // a person before it
  CHECK_FALSE(goes(40, 12, 3, 2));  // an object that moved there: it may rest
}

TEST_CASE("a noisy wall that many views see comes out flat") {
  const Parameters parameters{.settle = true};
  std::mt19937 random(5);
  std::normal_distribution<double> noise_m(0, parameters.noise * 16);
  const auto noisy_wall = [&] {
    cv::Mat depth(48, 64, CV_16UC1);
    for (auto& value : cv::Mat_<std::uint16_t>(depth))
      value = static_cast<std::uint16_t>((4 + noise_m(random)) * 5000);
    return depth;
  };
  LabelledCloud cloud;
  for (int i = 0; i < 500; ++i) cloud.push_back(at(0.003 * i - 0.75, 0.002 * i - 0.5, 4 + noise_m(random)));
  const PointBlocks blocks = blocks_of(cloud);
  std::vector<Votes> votes(cloud.size());
  for (int i = 0; i < 50; ++i) add_votes(blocks, small_camera(), {{}, noisy_wall(), {}}, parameters, votes);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    before += std::pow(blocks.points[i].z - 4, 2);
    after += std::pow(settled(blocks.points[i], votes[i], parameters).z - 4, 2);
  }
  CHECK(std::sqrt(after / 500) < std::sqrt(before / 500) / 5);
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
    add_votes(blocks_of(cloud), small_camera(), {{}, wall_at(3), {}}, {.settle = true}, votes);
  }
  const auto same = [](const Votes& a, const Votes& b) {
    return a.through == b.through && a.hits == b.hits && a.behind == b.behind && a.shown == b.shown &&
           a.person == b.person && a.weight == b.weight && a.x == b.x && a.y == b.y && a.z == b.z;
  };
  CHECK(std::equal(results[0].begin(), results[0].end(), results[1].begin(), same));
}
