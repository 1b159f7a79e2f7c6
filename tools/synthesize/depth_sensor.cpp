#include "tools/synthesize/depth_sensor.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/synthesize/noise_field.hpp"
#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

// Sum of four 16-bit uniforms, scaled to mean 0 and variance 1: nearly Gaussian, without libm.
float gaussian(std::uint64_t bits) {
  const int sum = static_cast<int>(bits & 0xffff) + static_cast<int>(bits >> 16 & 0xffff) +
                  static_cast<int>(bits >> 32 & 0xffff) + static_cast<int>(bits >> 48);
  return (static_cast<float>(sum) - 131070.f) * (1.7320508f / 65536.f);
}

/// What the sensor sees at one pixel, by row.
class Row {
 public:
  Row(const cv::Mat& depth_m, const Camera& camera, const DepthSensor& sensor, int v)
      : depth_m_(depth_m), camera_(camera), sensor_(sensor), v_(v) {}

  /// Pixels whose line to the projector, which sits to the left by the baseline, is cut by something nearer:
  /// along a row the projector's column u - d must grow; where it falls back, light is blocked.
  void mark_shadow(std::vector<std::uint8_t>& blocked) const {
    const float* z = depth_m_.ptr<float>(v_);
    const double scale = sensor_.disparity_m_px * camera_.width / 640.0;
    double farthest = -1e9;
    for (int u = 0; u < camera_.width; ++u) {
      if (z[u] <= 0) continue;
      const double column = u + scale / z[u];
      blocked[static_cast<std::size_t>(u)] = column < farthest - 1.0;
      farthest = std::max(farthest, column);
    }
  }

  /// Depth step to the neighbours beyond what a slanted plane shows, and the slant itself.
  void slope(int u, float& edge_m, float& slant) const {
    const int left = std::max(u - 1, 0), right = std::min(u + 1, camera_.width - 1);
    const int up = std::max(v_ - 1, 0), down = std::min(v_ + 1, camera_.height - 1);
    const float z = at(v_, u), l = at(v_, left), r = at(v_, right), a = at(up, u), b = at(down, u);
    edge_m = std::max(std::abs(l + r - 2 * z), std::abs(a + b - 2 * z));
    const float gx = static_cast<float>(camera_.fx) * std::min(std::abs(r - z), std::abs(z - l)) / z;
    const float gy = static_cast<float>(camera_.fy) * std::min(std::abs(b - z), std::abs(z - a)) / z;
    slant = std::sqrt(gx * gx + gy * gy);  // tangent of the angle of incidence
  }

 private:
  float at(int v, int u) const { return depth_m_.at<float>(v, u); }
  const cv::Mat& depth_m_;
  const Camera& camera_;
  const DepthSensor& sensor_;
  int v_;
};

}  // namespace

cv::Mat encode_depth(const cv::Mat& depth_m, const Camera& camera) {
  cv::Mat units(depth_m.size(), CV_16UC1);
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u)
      units.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(
          std::clamp(std::lround(depth_m.at<float>(v, u) * camera.depth_scale), 0L, 65535L));
  return units;
}

cv::Mat measure_depth(const cv::Mat& depth_m, const cv::Mat& loss, const Camera& camera,
                      const DepthSensor& sensor, std::uint64_t seed) {
  cv::Mat units(depth_m.size(), CV_16UC1, cv::Scalar(0));
  const double blobs = 4.0 * camera.width / 640;  // patches without value are a few pixels wide
  tbb::parallel_for(0, depth_m.rows, [&](int v) {
    const Row row(depth_m, camera, sensor, v);
    std::vector<std::uint8_t> blocked(static_cast<std::size_t>(depth_m.cols), 0);
    row.mark_shadow(blocked);
    for (int u = 0; u < depth_m.cols; ++u) {
      const std::uint64_t bits = hash(seed, static_cast<std::uint64_t>(u), static_cast<std::uint64_t>(v));
      // Edges are ragged: the value may come from a neighbour.
      const int su = std::clamp(u + static_cast<int>(bits % 3) - 1, 0, depth_m.cols - 1);
      const float z0 = depth_m.at<float>(v, u);
      const double z = std::abs(depth_m.at<float>(v, su) - z0) > 0.03f * z0 ? depth_m.at<float>(v, su) : z0;
      if (z < sensor.nearest_m || z > sensor.farthest_m || blocked[static_cast<std::size_t>(u)]) continue;
      float edge_m = 0, slant = 0;
      row.slope(u, edge_m, slant);
      double missing = edge_m > 0.04 * z ? 0.55 : 0;
      missing += std::clamp((slant - 3.0) / 5.0, 0.0, 1.0);
      missing += 0.6 * std::max(0.0, (z - sensor.fading_from_m) / (sensor.farthest_m - sensor.fading_from_m));
      missing += loss.at<float>(v, u);
      if (missing > 0) {
        const double patch = 0.5 + 0.5 * plane_noise(seed + 3, u / blobs, v / blobs);
        if (0.75 * patch + 0.25 * unit(mix(bits + 5)) < missing * 0.9) continue;
      }
      const double disparity = sensor.disparity_m_px / z + sensor.noise_px * gaussian(mix(bits + 1));
      const double stepped = std::round(disparity / sensor.step_px) * sensor.step_px;
      units.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(
          std::clamp(std::lround(sensor.disparity_m_px / stepped * camera.depth_scale), 0L, 65535L));
    }
  });
  return units;
}

}  // namespace sediment::synthetic
