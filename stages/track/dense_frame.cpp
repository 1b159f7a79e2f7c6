#include "stages/track/dense_frame.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sediment::track {
namespace {

constexpr int kWidth_px = 160;
constexpr float kEdgeSigmas = 8, kEdgeFloor_m = 0.01f;

// The largest difference of depth between neighbours on one surface.
float step_bound_m(float depth_m, float pixel_angle, float depth_noise) {
  constexpr float kSteepest = 4;  // tangent of the angle between ray and normal
  return kEdgeFloor_m + depth_m * pixel_angle * kSteepest + kEdgeSigmas * depth_noise * depth_m * depth_m;
}

std::uint16_t block_depth(const cv::Mat& depth, const cv::Mat& allowed, const cv::Rect& block,
                          double depth_scale, double pixel_angle, double depth_noise) {
  int count = 0, least = 65535, most = 0;
  std::int64_t sum = 0;
  for (int v = block.y; v < block.y + block.height; ++v) {
    const auto* row = depth.ptr<std::uint16_t>(v);
    const uchar* may = allowed.empty() ? nullptr : allowed.ptr<uchar>(v);
    for (int u = block.x; u < block.x + block.width; ++u) {
      if (may && !may[u]) return 0;
      if (!row[u]) continue;
      ++count;
      sum += row[u];
      least = std::min<int>(least, row[u]);
      most = std::max<int>(most, row[u]);
    }
  }
  if (2 * count < block.area()) return 0;
  const auto mean_m = static_cast<float>(static_cast<double>(sum) / count / depth_scale);
  const float bound_m =
      step_bound_m(mean_m, static_cast<float>(pixel_angle * block.width), static_cast<float>(depth_noise));
  if ((most - least) / depth_scale > bound_m) return 0;
  return static_cast<std::uint16_t>((sum + count / 2) / count);
}

// Half the size: brightness averaged, depth averaged where the four agree.
void halve(const std::vector<float>& fine, const std::vector<float>& fine_depth, int width, int height,
           float pixel_angle, float depth_noise, DenseImage& coarse) {
  const int w = width / 2, h = height / 2;
  coarse.brightness.resize(static_cast<std::size_t>(w) * h);
  coarse.depth_m.assign(static_cast<std::size_t>(w) * h, 0);
  for (int v = 0; v < h; ++v)
    for (int u = 0; u < w; ++u) {
      const int at = 2 * v * width + 2 * u;
      const int four[4] = {at, at + 1, at + width, at + width + 1};
      float sum = 0, sum_m = 0, least = 1e9f, most = 0;
      int count = 0;
      for (const int i : four) {
        sum += fine[i];
        if (fine_depth[i] <= 0) continue;
        ++count;
        sum_m += fine_depth[i];
        least = std::min(least, fine_depth[i]);
        most = std::max(most, fine_depth[i]);
      }
      coarse.brightness[v * w + u] = sum / 4;
      if (count >= 3 && most - least < step_bound_m(most, 2 * pixel_angle, depth_noise))
        coarse.depth_m[v * w + u] = sum_m / static_cast<float>(count);
    }
}

void add_points(const DenseCamera::Level& level, float pixel_angle, float depth_noise, DenseImage& image) {
  const auto vertex = [&](int i) {
    const float z = image.depth_m[i];
    return Vec3{level.rays[i].x * z, level.rays[i].y * z, z};
  };
  for (int v = 1; v + 1 < level.height; ++v)
    for (int u = 1; u + 1 < level.width; ++u) {
      const int i = v * level.width + u;
      const float z = image.depth_m[i];
      if (z <= 0) continue;
      DensePoint point;
      point.x = level.rays[i].x * z;
      point.y = level.rays[i].y * z;
      point.z = z;
      point.brightness = image.brightness[i];
      const float bound_m = step_bound_m(z, pixel_angle, depth_noise);
      bool smooth = true;
      for (const int j : {i - 1, i + 1, i - level.width, i + level.width})
        smooth = smooth && image.depth_m[j] > 0 && std::abs(image.depth_m[j] - z) < bound_m;
      if (smooth) {
        const Vec3 normal =
            cross(vertex(i + level.width) - vertex(i - level.width), vertex(i + 1) - vertex(i - 1));
        const double length = norm(normal);
        if (length > 1e-12) {
          point.nx = static_cast<float>(normal.x / length);
          point.ny = static_cast<float>(normal.y / length);
          point.nz = static_cast<float>(normal.z / length);
        }
      }
      image.points.push_back(point);
    }
}

}  // namespace

DenseCamera::DenseCamera(const Camera& full) : camera(full) {
  const int finest_px = std::max(1, (full.width + kWidth_px / 2) / kWidth_px);
  for (int i = 0; i < kDenseLevels; ++i) {
    Level& level = levels[i];
    level.block_px = finest_px << i;
    level.width = i == 0 ? full.width / finest_px : levels[i - 1].width / 2;
    level.height = i == 0 ? full.height / finest_px : levels[i - 1].height / 2;
    const double centre_px = 0.5 * (level.block_px - 1);
    for (int v = 0; v < level.height; ++v)
      for (int u = 0; u < level.width; ++u) {
        const Pixel ray = full.undistort({u * level.block_px + centre_px, v * level.block_px + centre_px});
        level.rays.push_back({static_cast<float>(ray.u), static_cast<float>(ray.v)});
      }
  }
}

Pixel DenseCamera::project(Vec3 point, int level) const {
  const Pixel full = camera.project(point);
  const double centre_px = 0.5 * (levels[level].block_px - 1);
  return {(full.u - centre_px) / levels[level].block_px, (full.v - centre_px) / levels[level].block_px};
}

DenseFrame dense_frame(const cv::Mat& gray, const cv::Mat& depth, const cv::Mat& allowed,
                       const DenseCamera& camera, double depth_noise) {
  const auto& level = camera.levels[0];
  const cv::Rect whole(0, 0, level.width * level.block_px, level.height * level.block_px);
  DenseFrame frame;
  cv::resize(gray(whole), frame.brightness, cv::Size(level.width, level.height), 0, 0, cv::INTER_AREA);
  frame.depth.create(level.height, level.width, CV_16UC1);
  for (int v = 0; v < level.height; ++v)
    for (int u = 0; u < level.width; ++u)
      frame.depth.at<std::uint16_t>(v, u) = block_depth(
          depth, allowed, {u * level.block_px, v * level.block_px, level.block_px, level.block_px},
          camera.camera.depth_scale, 1 / camera.camera.fx, depth_noise);
  return frame;
}

std::array<DenseImage, kDenseLevels> dense_images(const DenseFrame& frame, const DenseCamera& camera,
                                                  double depth_noise) {
  std::array<DenseImage, kDenseLevels> images;
  const auto noise = static_cast<float>(depth_noise);
  const auto scale = static_cast<float>(1 / camera.camera.depth_scale);
  for (int v = 0; v < frame.depth.rows; ++v)
    for (int u = 0; u < frame.depth.cols; ++u) {
      images[0].brightness.push_back(frame.brightness.at<uchar>(v, u));
      images[0].depth_m.push_back(static_cast<float>(frame.depth.at<std::uint16_t>(v, u)) * scale);
    }
  for (int i = 0; i < kDenseLevels; ++i) {
    const auto& level = camera.levels[i];
    const auto pixel_angle = static_cast<float>(level.block_px / camera.camera.fx);
    if (i > 0)
      halve(images[i - 1].brightness, images[i - 1].depth_m, camera.levels[i - 1].width,
            camera.levels[i - 1].height, pixel_angle / 2, noise, images[i]);
    add_points(level, pixel_angle, noise, images[i]);
  }
  return images;
}

}  // namespace sediment::track
