#include "tools/synthesize/renderer.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/synthesize/ray_tile.hpp"
#include "tools/synthesize/shading.hpp"

namespace sediment::synthetic {
namespace {

constexpr int kTile = 16;  // pixels a side
static_assert(kTile * kTile == RayTile::kRays);

cv::Vec3b pixel_of(const Rgb& c) {
  const auto byte = [](float v) {
    return static_cast<std::uint8_t>(std::clamp(v * 255.f + 0.5f, 0.f, 255.f));
  };
  return {byte(c.b), byte(c.g), byte(c.r)};
}

}  // namespace

/// What one rendering works on.
struct Renderer::View {
  const Scene& scene;
  const Moment& moment;
  const Pose& world_from_camera;
  std::vector<Target> targets;
  std::vector<Bounds> bounds;
  std::vector<std::vector<int>> candidates;  ///< solids that a tile may see
  Rendering image;
};

Renderer::Renderer(const Camera& camera) : camera_(camera), rays_(rays_of(camera)) {
  tiles_across_ = (camera.width + kTile - 1) / kTile;
  tiles_down_ = (camera.height + kTile - 1) / kTile;
  // Rays of one pixel around the tile: the samples of its border pixels reach beyond their centres.
  const float margin_x = static_cast<float>(1 / camera.fx), margin_y = static_cast<float>(1 / camera.fy);
  for (int tile = 0; tile < tiles_across_ * tiles_down_; ++tile) {
    const int left = tile % tiles_across_ * kTile, top = tile / tiles_across_ * kTile;
    Bounds b{kFar, -kFar, kFar, -kFar};
    for (int v = top; v < std::min(top + kTile, camera.height); ++v)
      for (int u = left; u < std::min(left + kTile, camera.width); ++u) {
        const Ray& ray = rays_[static_cast<std::size_t>(v) * camera.width + u];
        b = {std::min(b.x_low, ray.x), std::max(b.x_high, ray.x), std::min(b.y_low, ray.y),
             std::max(b.y_high, ray.y)};
      }
    tile_bounds_.push_back(
        {b.x_low - margin_x, b.x_high + margin_x, b.y_low - margin_y, b.y_high + margin_y});
  }
}

Renderer::Bounds Renderer::bounds_of(const PlacedSolid& placed, const Pose& camera_from_world) {
  constexpr double kNear = 0.02;
  const Pose camera_from_solid = camera_from_world * placed.world_from_solid;
  const Vec3 centre = camera_from_solid * centre_of(*placed.solid);
  const double radius = bounding_radius(*placed.solid);
  if (centre.z + radius < kNear) return {kFar, -kFar, kFar, -kFar};  // behind the camera
  if (placed.solid->shape == Shape::box) {
    Bounds b{kFar, -kFar, kFar, -kFar};
    const Vec3& h = placed.solid->size;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p =
          camera_from_solid * Vec3{corner & 1 ? h.x : -h.x, corner & 2 ? h.y : -h.y, corner & 4 ? h.z : -h.z};
      if (p.z < kNear) return {-kFar, kFar, -kFar, kFar};  // reaches behind the camera: may be anywhere
      const float x = static_cast<float>(p.x / p.z), y = static_cast<float>(p.y / p.z);
      b = {std::min(b.x_low, x), std::max(b.x_high, x), std::min(b.y_low, y), std::max(b.y_high, y)};
    }
    return b;
  }
  const double nearest = centre.z - radius, farthest = centre.z + radius;
  if (nearest < kNear) return {-kFar, kFar, -kFar, kFar};
  const auto low = [&](double c) {
    return static_cast<float>(std::min((c - radius) / nearest, (c - radius) / farthest));
  };
  const auto high = [&](double c) {
    return static_cast<float>(std::max((c + radius) / nearest, (c + radius) / farthest));
  };
  return {low(centre.x), high(centre.x), low(centre.y), high(centre.y)};
}

void Renderer::find_hits(View& view, int tile_idx) const {
  const Bounds& t = tile_bounds_[tile_idx];
  auto& candidates = view.candidates[tile_idx];
  for (std::size_t i = 0; i < view.bounds.size(); ++i) {
    const Bounds& b = view.bounds[i];
    if (b.x_low <= t.x_high && b.x_high >= t.x_low && b.y_low <= t.y_high && b.y_high >= t.y_low)
      candidates.push_back(static_cast<int>(i));
  }
  const int left = tile_idx % tiles_across_ * kTile, top = tile_idx / tiles_across_ * kTile;
  RayTile tile;
  for (int i = 0; i < RayTile::kRays; ++i) {
    const int u = std::min(left + i % kTile, camera_.width - 1),
              v = std::min(top + i / kTile, camera_.height - 1);
    const Ray& ray = rays_[static_cast<std::size_t>(v) * camera_.width + u];
    tile.x[i] = ray.x, tile.y[i] = ray.y, tile.depth_m[i] = kFar, tile.solid[i] = -1;
  }
  for (const int solid_idx : candidates) cast(view.targets[solid_idx], solid_idx, tile);
  for (int i = 0; i < RayTile::kRays; ++i) {
    const int u = left + i % kTile, v = top + i / kTile;
    if (u >= camera_.width || v >= camera_.height) continue;
    view.image.solid.at<int>(v, u) = tile.solid[i];
    view.image.depth_m.at<float>(v, u) = tile.solid[i] < 0 ? 0 : tile.depth_m[i];
  }
}

void Renderer::paint(View& view, int tile_idx) const {
  const int left = tile_idx % tiles_across_ * kTile, top = tile_idx / tiles_across_ * kTile;
  for (int v = top; v < std::min(top + kTile, camera_.height); ++v)
    for (int u = left; u < std::min(left + kTile, camera_.width); ++u) {
      const int solid_idx = view.image.solid.at<int>(v, u);
      if (solid_idx < 0) continue;
      const Ray& ray = rays_[static_cast<std::size_t>(v) * camera_.width + u];
      const Shade s = shade(view.scene, view.moment.solids[solid_idx], view.world_from_camera, ray.x, ray.y,
                            view.image.depth_m.at<float>(v, u), 1 / camera_.fx);
      view.image.color.at<cv::Vec3b>(v, u) = pixel_of(s.color);
      view.image.face.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(s.face);
      view.image.place.at<cv::Vec2f>(v, u) = {s.u_m, s.v_m};
    }
}

// Four samples a pixel (rotated grid) where a pixel's neighbours show another face.
void Renderer::smooth_edges(View& view, int tile_idx, const std::vector<int>& pixels) const {
  constexpr int kSamples = 4, kBatch = RayTile::kRays / kSamples;
  constexpr double kOffset[kSamples][2] = {
      {-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}};
  RayTile tile;
  for (std::size_t first = 0; first < pixels.size(); first += kBatch) {
    const int count = static_cast<int>(std::min<std::size_t>(kBatch, pixels.size() - first));
    for (int i = 0; i < RayTile::kRays; ++i) {
      const int pixel = pixels[first + std::min(i / kSamples, count - 1)];
      const double* offset = kOffset[i % kSamples];
      const Pixel ray =
          camera_.undistort({pixel % camera_.width + offset[0], pixel / camera_.width + offset[1]});
      tile.x[i] = static_cast<float>(ray.u), tile.y[i] = static_cast<float>(ray.v);
      tile.depth_m[i] = kFar, tile.solid[i] = -1;
    }
    for (const int solid_idx : view.candidates[tile_idx]) cast(view.targets[solid_idx], solid_idx, tile);
    for (int i = 0; i < count; ++i) {
      Rgb sum;
      for (int sample = kSamples * i; sample < kSamples * (i + 1); ++sample)
        if (tile.solid[sample] >= 0)
          sum = sum + shade(view.scene, view.moment.solids[tile.solid[sample]], view.world_from_camera,
                            tile.x[sample], tile.y[sample], tile.depth_m[sample], 1 / camera_.fx)
                          .color;
      const int pixel = pixels[first + i];
      view.image.color.at<cv::Vec3b>(pixel / camera_.width, pixel % camera_.width) =
          pixel_of((1.f / kSamples) * sum);
    }
  }
}

Rendering Renderer::render(const Scene& scene, const Moment& moment, const Pose& world_from_camera) const {
  const cv::Size size(camera_.width, camera_.height);
  View view{scene, moment, world_from_camera, {}, {}, {}, {}};
  view.image = {cv::Mat(size, CV_8UC3, cv::Scalar::all(0)), cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32SC1),
                cv::Mat(size, CV_8UC1, cv::Scalar(0)), cv::Mat(size, CV_32FC2, cv::Scalar::all(0))};
  const Pose camera_from_world = world_from_camera.inverse();
  for (const PlacedSolid& placed : moment.solids) {
    view.targets.push_back(target_of(*placed.solid, camera_from_world * placed.world_from_solid));
    view.bounds.push_back(bounds_of(placed, camera_from_world));
  }
  const int tiles = tiles_across_ * tiles_down_;
  view.candidates.resize(tiles);
  tbb::parallel_for(0, tiles, [&](int tile) { find_hits(view, tile); });
  tbb::parallel_for(0, tiles, [&](int tile) { paint(view, tile); });

  const auto differs = [&](int v, int u, int v2, int u2) {
    return view.image.solid.at<int>(v, u) != view.image.solid.at<int>(v2, u2) ||
           view.image.face.at<std::uint8_t>(v, u) != view.image.face.at<std::uint8_t>(v2, u2);
  };
  tbb::parallel_for(0, tiles, [&](int tile) {
    std::vector<int> edges;
    const int left = tile % tiles_across_ * kTile, top = tile / tiles_across_ * kTile;
    for (int v = top; v < std::min(top + kTile, camera_.height); ++v)
      for (int u = left; u < std::min(left + kTile, camera_.width); ++u)
        if ((u > 0 && differs(v, u, v, u - 1)) || (u + 1 < camera_.width && differs(v, u, v, u + 1)) ||
            (v > 0 && differs(v, u, v - 1, u)) || (v + 1 < camera_.height && differs(v, u, v + 1, u)))
          edges.push_back(v * camera_.width + u);
    smooth_edges(view, tile, edges);
  });
  return std::move(view.image);
}

}  // namespace sediment::synthetic
