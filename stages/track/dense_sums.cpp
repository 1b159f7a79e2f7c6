#include "stages/track/dense_sums.hpp"

#include <cmath>

namespace sediment::track {
namespace {

float tukey(float residual, float scale) {
  const float t = residual / (4.685f * scale);
  return std::abs(t) >= 1 ? 0 : (1 - t * t) * (1 - t * t);
}

// A camera pose and lens in single precision.
struct Projection {
  float r[9], t[3], fx, fy, cx, cy, k1, k2, p1, p2, k3;

  Projection(const DenseCamera& camera, int level, const Pose& pose) {
    for (int i = 0; i < 9; ++i) r[i] = static_cast<float>(pose.rotation[i]);
    t[0] = static_cast<float>(pose.translation.x);
    t[1] = static_cast<float>(pose.translation.y);
    t[2] = static_cast<float>(pose.translation.z);
    const Camera& full = camera.camera;
    const double block = camera.levels[level].block_px;
    fx = static_cast<float>(full.fx / block);
    fy = static_cast<float>(full.fy / block);
    cx = static_cast<float>((full.cx - 0.5 * (block - 1)) / block);
    cy = static_cast<float>((full.cy - 0.5 * (block - 1)) / block);
    float* const lens[5] = {&k1, &k2, &p1, &p2, &k3};
    for (int i = 0; i < 5; ++i) *lens[i] = static_cast<float>(full.distortion[i]);
  }
  void rotate(const float* p, float* q) const {
    for (std::ptrdiff_t i = 0; i < 3; ++i) q[i] = r[3 * i] * p[0] + r[3 * i + 1] * p[1] + r[3 * i + 2] * p[2];
  }
  void pixel(const float* p, float& u, float& v) const {
    const float x = p[0] / p[2], y = p[1] / p[2], rr = x * x + y * y;
    const float radial = 1 + rr * (k1 + rr * (k2 + rr * k3));
    u = fx * (x * radial + 2 * p1 * x * y + p2 * (rr + 2 * x * x)) + cx;
    v = fy * (y * radial + p1 * (rr + 2 * y * y) + 2 * p2 * x * y) + cy;
  }
};

void add_distance(const DensePoint& point, const float* p, const Projection& projection, const Ray& ray,
                  float depth_m, float sigma_m, const DenseScales& scales, DenseSums& sums) {
  float n[3];
  projection.rotate(&point.nx, n);
  const float distance =
      (n[0] * (p[0] - ray.x * depth_m) + n[1] * (p[1] - ray.y * depth_m) + n[2] * (p[2] - depth_m)) / sigma_m;
  sums.distances.add(std::abs(distance));
  const float weight = tukey(distance, scales.distance);
  if (weight <= 0) return;
  ++sums.seen;
  const float jacobian[6] = {(p[1] * n[2] - p[2] * n[1]) / sigma_m,
                             (p[2] * n[0] - p[0] * n[2]) / sigma_m,
                             (p[0] * n[1] - p[1] * n[0]) / sigma_m,
                             n[0] / sigma_m,
                             n[1] / sigma_m,
                             n[2] / sigma_m};
  sums.equations.add(jacobian, distance, weight / (scales.distance * scales.distance));
}

// Brightness of the current frame at a place and its derivatives by u and v (bilinear).
struct Brightness {
  float value, by_u, by_v;
};

Brightness brightness_at(const std::vector<float>& image, int width, float u, float v) {
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const float a = u - static_cast<float>(x), b = v - static_cast<float>(y);
  const float* p = image.data() + static_cast<std::ptrdiff_t>(y) * width + x;
  const float top = p[0] + a * (p[1] - p[0]), bottom = p[width] + a * (p[width + 1] - p[width]);
  // Central differences over two pixels: smoother than the derivative of the interpolation.
  const float left = p[-1] + b * (p[width - 1] - p[-1]), right = p[2] + b * (p[width + 2] - p[2]);
  const float middle_left = p[0] + b * (p[width] - p[0]), middle_right = p[1] + b * (p[width + 1] - p[1]);
  const float above = p[-width] + a * (p[1 - width] - p[-width]);
  const float* beneath = p + 2 * static_cast<std::ptrdiff_t>(width);
  const float below = beneath[0] + a * (beneath[1] - beneath[0]);
  return {top + b * (bottom - top), 0.5f * ((1 - a) * (middle_right - left) + a * (right - middle_left)),
          0.5f * ((1 - b) * (bottom - above) + b * (below - top))};
}

void add_difference(const DensePoint& point, const float* p, const Projection& projection,
                    const Brightness& seen, const DenseScales& scales, DenseSums& sums) {
  const float difference = seen.value - scales.gain * point.brightness;
  sums.differences.add(std::abs(difference));
  const float weight = tukey(difference, scales.brightness);
  if (weight <= 0) return;
  sums.cross_brightness += static_cast<double>(weight * seen.value * point.brightness);
  sums.squared_brightness += static_cast<double>(weight * point.brightness * point.brightness);
  const float gx = seen.by_u * projection.fx / p[2], gy = seen.by_v * projection.fy / p[2];
  const float gz = -(gx * p[0] + gy * p[1]) / p[2];
  const float jacobian[6] = {p[1] * gz - p[2] * gy, p[2] * gx - p[0] * gz, p[0] * gy - p[1] * gx, gx, gy, gz};
  sums.equations.add(jacobian, difference, weight / (scales.brightness * scales.brightness));
}

}  // namespace

DenseSums sums_at(const DenseImage& reference, const DenseImage& current, const DenseCamera& camera,
                  int level_idx, const Pose& pose, const DenseScales& scales, float depth_noise) {
  const auto& level = camera.levels[level_idx];
  const Projection projection(camera, level_idx, pose);
  DenseSums sums;
  std::size_t in_row = 0;
  for (const DensePoint& point : reference.points) {
    if (++in_row % 128 == 0) sums.equations.flush();
    float p[3], u = 0, v = 0;
    projection.rotate(&point.x, p);
    for (int i = 0; i < 3; ++i) p[i] += projection.t[i];
    if (p[2] < 0.1f) continue;
    projection.pixel(p, u, v);
    if (!(u >= 1 && v >= 1 && u < static_cast<float>(level.width - 2) &&
          v < static_cast<float>(level.height - 2)))
      continue;
    const float up_v = v + 0.5f, up_u = u + 0.5f;  // cut off, they are the nearest pixel: both are above 1
    const int nearest = static_cast<int>(up_v) * level.width + static_cast<int>(up_u);
    const float depth_m = current.depth_m[nearest];
    if (depth_m <= 0 || std::abs(depth_m - p[2]) > 0.05f + 0.1f * p[2]) continue;  // none, or another surface
    if (point.nz != 0)
      add_distance(point, p, projection, level.rays[nearest], depth_m, depth_noise * p[2] * p[2] + 0.001f,
                   scales, sums);
    add_difference(point, p, projection, brightness_at(current.brightness, level.width, u, v), scales, sums);
  }
  sums.equations.flush();
  return sums;
}

}  // namespace sediment::track
