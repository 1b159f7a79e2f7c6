#include "tools/synthesize/renderer.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

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

/// Casts at the candidates (nearest first) until the rest is behind everything that was hit.
void cast_all(const std::vector<int>& candidates, const std::vector<SolidView>& solids, RayTile& tile) {
  for (const int solid_idx : candidates) {
    const SolidView& solid = solids[static_cast<std::size_t>(solid_idx)];
    if (solid.reach.nearest_m > tile.farthest_m()) break;
    cast(solid.target, solid.reach, solid_idx, tile);
  }
}

}  // namespace

/// What one rendering works on.
struct Renderer::Work {
  View view;
  std::vector<int> nearest_first;            ///< indices of solids that may be seen at all
  std::vector<std::vector<int>> candidates;  ///< of a tile, nearest first
  Rendering image;
};

Renderer::Renderer(const Camera& camera) : camera_(camera), rays_(rays_of(camera)) {
  tiles_across_ = (camera.width + kTile - 1) / kTile;
  tiles_down_ = (camera.height + kTile - 1) / kTile;
  for (int tile = 0; tile < tiles_across_ * tiles_down_; ++tile) {
    RayBounds bounds;
    const cv::Rect area = area_of(tile);
    // A pixel more on each side: the samples of border pixels reach beyond their centres.
    for (int v = area.y; v < area.br().y; ++v)
      for (int u = area.x; u < area.br().x; ++u) {
        const Ray& ray = rays_[static_cast<std::size_t>(v) * camera.width + u];
        const float dx = static_cast<float>(1 / camera.fx), dy = static_cast<float>(1 / camera.fy);
        bounds.include(ray.x - dx, ray.y - dy);
        bounds.include(ray.x + dx, ray.y + dy);
      }
    tile_bounds_.push_back(bounds);
  }
}

cv::Rect Renderer::area_of(int tile_idx) const {
  const int left = tile_idx % tiles_across_ * kTile, top = tile_idx / tiles_across_ * kTile;
  return {left, top, std::min(kTile, camera_.width - left), std::min(kTile, camera_.height - top)};
}

void Renderer::paint(Work& work, int tile_idx) const {
  auto& candidates = work.candidates[static_cast<std::size_t>(tile_idx)];
  for (const int i : work.nearest_first)
    if (work.view.solids[static_cast<std::size_t>(i)].reach.rays.meets(
            tile_bounds_[static_cast<std::size_t>(tile_idx)]))
      candidates.push_back(i);
  const cv::Rect area = area_of(tile_idx);
  RayTile tile;
  for (int i = 0; i < RayTile::kRays; ++i) {
    // Rays beyond the image's border repeat the last one.
    const int u = area.x + std::min(i % kTile, area.width - 1),
              v = area.y + std::min(i / kTile, area.height - 1);
    const Ray& ray = rays_[static_cast<std::size_t>(v) * camera_.width + u];
    tile.x[i] = ray.x, tile.y[i] = ray.y;
  }
  tile.start();
  cast_all(candidates, work.view.solids, tile);
  Shades shades;
  shade(work.view, tile, kTile * area.height, shades);
  for (int y = 0; y < area.height; ++y)
    for (int x = 0; x < area.width; ++x) {
      const int i = y * kTile + x, u = area.x + x, v = area.y + y;
      work.image.solid.at<int>(v, u) = tile.solid[i];
      work.image.depth_m.at<float>(v, u) = tile.solid[i] < 0 ? 0 : tile.depth_m[i];
      if (tile.solid[i] < 0) continue;
      work.image.color.at<cv::Vec3b>(v, u) =
          pixel_of({shades.color.r[i], shades.color.g[i], shades.color.b[i]});
      work.image.face.at<std::uint8_t>(v, u) = shades.face[i];
      work.image.place.at<cv::Vec2f>(v, u) = {shades.u_m[i], shades.v_m[i]};
    }
}

/// Pixels with another face beside them.
std::vector<int> Renderer::edge_pixels(const Work& work, int tile_idx) const {
  const cv::Mat &solid = work.image.solid, &face = work.image.face;
  std::vector<int> pixels;
  const cv::Rect area = area_of(tile_idx);
  for (int v = area.y; v < area.br().y; ++v) {
    const int up = std::max(v - 1, 0), down = std::min(v + 1, camera_.height - 1);
    const int *solids = solid.ptr<int>(v), *above = solid.ptr<int>(up), *below = solid.ptr<int>(down);
    const auto *faces = face.ptr(v), *faces_above = face.ptr(up), *faces_below = face.ptr(down);
    for (int u = area.x; u < area.br().x; ++u) {
      const int left = std::max(u - 1, 0), right = std::min(u + 1, camera_.width - 1);
      const int differs = (solids[u] ^ solids[left]) | (solids[u] ^ solids[right]) | (solids[u] ^ above[u]) |
                          (solids[u] ^ below[u]) | (faces[u] ^ faces[left]) | (faces[u] ^ faces[right]) |
                          (faces[u] ^ faces_above[u]) | (faces[u] ^ faces_below[u]);
      if (differs != 0) pixels.push_back(v * camera_.width + u);
    }
  }
  return pixels;
}

// Four samples a pixel, on a rotated grid.
void Renderer::smooth_edges(Work& work, int tile_idx) const {
  constexpr int kSamples = 4, kBatch = RayTile::kRays / kSamples;
  constexpr double kOffset[kSamples][2] = {
      {-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}};
  const std::vector<int> pixels = edge_pixels(work, tile_idx);
  RayTile tile;
  Shades shades;
  for (std::size_t first = 0; first < pixels.size(); first += kBatch) {
    const int count = static_cast<int>(std::min<std::size_t>(kBatch, pixels.size() - first));
    for (int i = 0; i < RayTile::kRays; ++i) {
      const int pixel = pixels[first + static_cast<std::size_t>(std::min(i / kSamples, count - 1))];
      const double* offset = kOffset[i % kSamples];
      const Pixel ray =
          camera_.undistort({pixel % camera_.width + offset[0], pixel / camera_.width + offset[1]});
      tile.x[i] = static_cast<float>(ray.u), tile.y[i] = static_cast<float>(ray.v);
    }
    tile.start(kSamples * count);
    cast_all(work.candidates[static_cast<std::size_t>(tile_idx)], work.view.solids, tile);
    shade(work.view, tile, kSamples * count, shades);
    for (int i = 0; i < count; ++i) {
      Rgb sum;
      for (int s = kSamples * i; s < kSamples * (i + 1); ++s)
        if (tile.solid[s] >= 0) sum = sum + Rgb{shades.color.r[s], shades.color.g[s], shades.color.b[s]};
      const int pixel = pixels[first + static_cast<std::size_t>(i)];
      work.image.color.at<cv::Vec3b>(pixel / camera_.width, pixel % camera_.width) =
          pixel_of((1.f / kSamples) * sum);
    }
  }
}

Rendering Renderer::render(const Scene& scene, const Lighting& lighting, const Moment& moment,
                           const Pose& world_from_camera) const {
  const cv::Size size(camera_.width, camera_.height);
  Work work{view_of(scene, lighting, moment, world_from_camera, 1 / camera_.fx), {}, {}, {}};
  work.image = {cv::Mat(size, CV_8UC3, cv::Scalar::all(0)), cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32SC1),
                cv::Mat(size, CV_8UC1, cv::Scalar(0)), cv::Mat(size, CV_32FC2, cv::Scalar::all(0))};
  work.nearest_first.resize(work.view.solids.size());
  std::iota(work.nearest_first.begin(), work.nearest_first.end(), 0);
  std::stable_sort(work.nearest_first.begin(), work.nearest_first.end(), [&](int a, int b) {
    const auto nearest = [&](int i) { return work.view.solids[static_cast<std::size_t>(i)].reach.nearest_m; };
    return nearest(a) < nearest(b);
  });
  const int tiles = tiles_across_ * tiles_down_;
  work.candidates.resize(static_cast<std::size_t>(tiles));
  tbb::parallel_for(0, tiles, [&](int tile) { paint(work, tile); });
  tbb::parallel_for(0, tiles, [&](int tile) { smooth_edges(work, tile); });
  return std::move(work.image);
}

}  // namespace sediment::synthetic
