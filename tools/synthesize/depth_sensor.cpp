#include "tools/synthesize/depth_sensor.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/synthesize/noise_field.hpp"
#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

std::uint16_t units_of(double depth_m, const Camera& camera) {
  return static_cast<std::uint16_t>(std::clamp(depth_m * camera.depth_scale + 0.5, 0.0, 65535.0));
}

// Sum of four 16-bit uniforms, scaled to mean 0 and variance 1: nearly Gaussian, without libm.
float gaussian(std::uint64_t bits) {
  const int sum = static_cast<int>(bits & 0xffff) + static_cast<int>(bits >> 16 & 0xffff) +
                  static_cast<int>(bits >> 32 & 0xffff) + static_cast<int>(bits >> 48);
  return (static_cast<float>(sum) - 131070.f) * (1.7320508f / 65536.f);
}

/// Noise of variance 1. The sensor matches windows, so neighbours in its 640 pixel wide image share noise; in
/// a smaller image neighbours are too far apart for that.
cv::Mat noise_image(const Camera& camera, std::uint64_t seed) {
  const bool shared = camera.width > 480;
  cv::Mat white(camera.height + 2, camera.width + 2, CV_32FC1), noise(camera.height, camera.width, CV_32FC1);
  tbb::parallel_for(0, white.rows, [&](int v) {
    for (int u = 0; u < white.cols; ++u)
      white.at<float>(v, u) =
          gaussian(hash(seed, static_cast<std::uint64_t>(u), static_cast<std::uint64_t>(v)));
  });
  tbb::parallel_for(0, noise.rows, [&](int v) {
    const float *a = white.ptr<float>(v), *b = white.ptr<float>(v + 1), *c = white.ptr<float>(v + 2);
    float* out = noise.ptr<float>(v);
    const auto column = [&](int u) { return a[u] + 2 * b[u] + c[u]; };
    // Weights 1 2 1 both ways have a sum of squares of 36.
    for (int u = 0; u < noise.cols; ++u)
      out[u] = shared ? (column(u) + 2 * column(u + 1) + column(u + 2)) / 6 : b[u + 1];
  });
  return noise;
}

/// Pixels of a row whose line to the projector, which sits beside the camera by the baseline, is cut by
/// something nearer: the projector's column u + d must grow along the row; where it falls back, light is
/// blocked.
void mark_shadow(const float* depth_m, const Camera& camera, const DepthSensor& sensor,
                 std::vector<char>& blocked) {
  const double scale = sensor.disparity_m_px * camera.width / 640.0;
  double farthest = -1e9;
  for (int u = 0; u < camera.width; ++u) {
    blocked[static_cast<std::size_t>(u)] = 0;
    if (depth_m[u] <= 0) continue;
    const double column = u + scale / depth_m[u];
    blocked[static_cast<std::size_t>(u)] = column < farthest - 1.0;
    farthest = std::max(farthest, column);
  }
}

struct Relief {
  double edge_m;  ///< step to the neighbours beyond what a slanted plane shows
  double slant;   ///< tangent of the angle of incidence
};
Relief relief_at(const cv::Mat& depth_m, const Camera& camera, int v, int u) {
  const int up = std::max(v - 1, 0), down = std::min(v + 1, depth_m.rows - 1);
  const float* row = depth_m.ptr<float>(v);
  const float z = row[u], l = row[std::max(u - 1, 0)], r = row[std::min(u + 1, depth_m.cols - 1)];
  const float a = depth_m.at<float>(up, u), b = depth_m.at<float>(down, u);
  // The smaller difference of the two sides: a step on one side is no slant.
  const double gx = camera.fx * std::min(std::abs(r - z), std::abs(z - l)) / z;
  const double gy = camera.fy * std::min(std::abs(b - z), std::abs(z - a)) / z;
  return {std::max(std::abs(l + r - 2 * z), std::abs(a + b - 2 * z)), std::sqrt(gx * gx + gy * gy)};
}

/// Share of the pixels like this one that get no value.
double missing_share(const Relief& relief, double z, const DepthSensor& s) {
  double share = relief.edge_m > s.edge_share * z ? s.edge_loss : 0;
  share += std::clamp((relief.slant - s.slant_from) / (s.slant_to - s.slant_from), 0.0, 1.0);
  return share + 0.6 * std::max(0.0, (z - s.fading_from_m) / (s.farthest_m - s.fading_from_m));
}

}  // namespace

cv::Mat encode_depth(const cv::Mat& depth_m, const Camera& camera) {
  cv::Mat units(depth_m.size(), CV_16UC1);
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u)
      units.at<std::uint16_t>(v, u) = units_of(depth_m.at<float>(v, u), camera);
  return units;
}

cv::Mat measure_depth(const cv::Mat& depth_m, const cv::Mat& loss, const Camera& camera,
                      const DepthSensor& sensor, std::uint64_t seed) {
  cv::Mat units(depth_m.size(), CV_16UC1, cv::Scalar(0));
  const cv::Mat noise = noise_image(camera, hash(seed, 1));
  const double patch_px = std::max(1.5, 4.0 * camera.width / 640);  // holes are patches
  tbb::parallel_for(0, depth_m.rows, [&](int v) {
    std::vector<char> blocked(static_cast<std::size_t>(depth_m.cols));
    mark_shadow(depth_m.ptr<float>(v), camera, sensor, blocked);
    for (int u = 0; u < depth_m.cols; ++u) {
      const float here = depth_m.at<float>(v, u);
      if (here <= 0 || blocked[static_cast<std::size_t>(u)]) continue;
      const std::uint64_t bits = hash(seed, static_cast<std::uint64_t>(u), static_cast<std::uint64_t>(v));
      // Edges are ragged: beyond a step the value may come from a neighbour.
      const float beside =
          depth_m.at<float>(v, std::clamp(u + static_cast<int>(bits % 3) - 1, 0, depth_m.cols - 1));
      const double z = std::abs(beside - here) > sensor.edge_share * here ? beside : here;
      if (z < sensor.nearest_m || z > sensor.farthest_m) continue;
      const double missing =
          missing_share(relief_at(depth_m, camera, v, u), z, sensor) + loss.at<float>(v, u);
      if (missing > 0) {
        const double patch = 0.5 + 0.6 * plane_noise(hash(seed, 2), u / patch_px, v / patch_px);
        if (0.7 * patch + 0.3 * unit(mix(bits)) < missing) continue;
      }
      const double disparity = sensor.disparity_m_px / z + sensor.noise_px * noise.at<float>(v, u);
      const double steps = std::max(1.0, std::floor(disparity / sensor.step_px + 0.5));
      units.at<std::uint16_t>(v, u) = units_of(sensor.disparity_m_px / (steps * sensor.step_px), camera);
    }
  });
  return units;
}

}  // namespace sediment::synthetic
