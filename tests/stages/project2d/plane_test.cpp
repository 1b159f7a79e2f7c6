#include "stages/project2d/plane.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace sediment;
using namespace sediment::project2d;

namespace {

std::vector<Vec3> points_on(const Plane& plane, std::size_t count, double noise_m, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-2, 2);
  std::normal_distribution<double> noise(0, noise_m);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p{along(random), along(random), along(random)};
    points.push_back(p - (plane.height_m(p) - noise(random)) * plane.normal);
  }
  return points;
}

}  // namespace

TEST_CASE("least squares gives back the plane that points lie on") {
  const Plane truth{normalized({1, 2, -3}), 0.7};
  Plane fitted = fit_plane(points_on(truth, 100, 0, 1)).plane;
  if (dot(fitted.normal, truth.normal) < 0) fitted = fitted.flipped();
  CHECK(norm(fitted.normal - truth.normal) < 1e-12);
  CHECK(fitted.offset_m == Approx(0.7));
}
