#include "stages/repair/speed.hpp"

#include <catch2/catch.hpp>

#include "tests/stages/repair/moving_card.hpp"

using namespace sediment;
using namespace sediment::repair;
using namespace sediment::repair::test;

namespace {

const Camera kCamera{160, 120, 150, 150, 79.5, 59.5, {}, kScale};

std::map<int, Displacement> moved(int step_px, const std::vector<int>& movers) {
  CardScene scene;
  scene.step_px = step_px;
  const Clip clip = clip_of({scene.frame(0), scene.frame(1)});
  return displacements(clip.at(0), clip.at(1), clip.at(0).detections, movers, kCamera, rays_of(kCamera));
}

}  // namespace

TEST_CASE("an object's displacement is measured in metres, whether or not it may move by itself") {
  const std::vector<int> movers = GENERATE(std::vector<int>{}, std::vector<int>{1});
  const auto displacement = moved(3, movers).at(1);
  CHECK(displacement.x_m == Approx(3.0 / 150).epsilon(0.1));  // 3 pixels at 1 m
  CHECK(std::abs(displacement.y_m) < 0.002);
  CHECK(displacement.seconds == Approx(1.0 / 30));
  CHECK(displacement.error_m < 0.002);
}

TEST_CASE("an object at rest has no displacement") {
  const auto displacement = moved(0, {}).at(1);
  CHECK(std::hypot(displacement.x_m, displacement.y_m) < 1e-3);
}

TEST_CASE("speeds sum the vectors of five frames, so that trembling is no motion") {
  std::map<std::size_t, Displacement> trembling, steady;
  for (std::size_t i = 0; i < 20; ++i) {
    trembling[i] = {i % 2 ? 0.01 : -0.01, 0, 0.04, 0};
    steady[i] = {0.01, 0, 0.04, 0.002};
  }
  CHECK(speeds(trembling).at(10) == Approx(0.01 / 0.2));
  CHECK(speeds(steady).at(10) == Approx(0.05 / 0.2 - 0.01 / 0.2));  // less the error
  CHECK(speeds(steady).at(0) == Approx(0.03 / 0.12 - 0.006 / 0.12));
  CHECK(speeds({{4, {0.001, 0, 0.04, 0.002}}}).at(4) == 0);
  CHECK(speeds({}).empty());
}
