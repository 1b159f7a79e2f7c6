#include "pipeline/scene/camera.hpp"

#include <algorithm>
#include <cmath>

namespace sediment {
namespace {

/// Brown-Conrady: where the ray (x, y) is seen on the normalised image plane.
Pixel distort(const std::array<double, 5>& d, double x, double y) {
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  return {x * radial + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x),
          y * radial + d[2] * (r2 + 2 * y * y) + 2 * d[3] * x * y};
}

/// One Newton step of distort(x, y) = (seen) with a numeric Jacobian.
void newton_step(const std::array<double, 5>& d, Pixel seen, double& x, double& y) {
  constexpr double h = 1e-6;
  const Pixel at = distort(d, x, y), dx = distort(d, x + h, y), dy = distort(d, x, y + h);
  const double a = (dx.u - at.u) / h, b = (dy.u - at.u) / h, c = (dx.v - at.v) / h, e = (dy.v - at.v) / h;
  const double determinant = a * e - b * c;
  if (std::abs(determinant) < 1e-9) return;
  const double ru = seen.u - at.u, rv = seen.v - at.v;
  x += (e * ru - b * rv) / determinant;
  y += (a * rv - c * ru) / determinant;
}

}  // namespace

bool Camera::has_distortion() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0; });
}

Pixel Camera::undistort(Pixel pixel) const {
  const Pixel seen{(pixel.u - cx) / fx, (pixel.v - cy) / fy};
  if (!has_distortion()) return seen;
  double x = seen.u, y = seen.v;
  for (int i = 0; i < 5; ++i) {
    const Pixel at = distort(distortion, x, y);
    x += seen.u - at.u;
    y += seen.v - at.v;
  }
  for (int i = 0; i < 4; ++i) newton_step(distortion, seen, x, y);
  return {x, y};
}

Pixel Camera::project(Vec3 point) const {
  if (!has_distortion()) return project_straight(point);
  const Pixel seen = distort(distortion, point.x / point.z, point.y / point.z);
  return {fx * seen.u + cx, fy * seen.v + cy};
}

std::vector<Ray> rays_of(const Camera& camera) {
  std::vector<Ray> rays(static_cast<std::size_t>(camera.width) * camera.height);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Pixel ray = camera.undistort({static_cast<double>(u), static_cast<double>(v)});
      rays[static_cast<std::size_t>(v) * camera.width + u] = {static_cast<float>(ray.u),
                                                              static_cast<float>(ray.v)};
    }
  return rays;
}

}  // namespace sediment
