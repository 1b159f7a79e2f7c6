#include "stages/project2d/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>

namespace sediment::project2d {
namespace {

constexpr double kSpacing_m = 0.05;
constexpr double kPatchSides_m[] = {0.25, 0.5, 1.0};
constexpr std::size_t kLeastSamples = 6;
constexpr int kTriples = 40;
/// A patch spreads at least this share of the cube's side (root mean square) in both directions; a full one
/// 0.29.
constexpr double kLeastExtent = 0.15;

using Cube = std::array<double, 3>;

Cube cube_of(Vec3 p, double side_m) {
  return {std::floor(p.x / side_m), std::floor(p.y / side_m), std::floor(p.z / side_m)};
}

/// Sorts the points by cube and calls `use(begin, end)` for the points of each one.
template <class Use>
void for_each_cube(std::vector<Vec3>& points, double side_m, Use use) {
  std::vector<std::pair<Cube, std::size_t>> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order[i] = {cube_of(points[i], side_m), i};
  std::sort(order.begin(), order.end());
  std::vector<Vec3> sorted(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = points[order[i].second];
  points.swap(sorted);
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && order[end].first == order[begin].first) ++end;
    use(begin, end);
    begin = end;
  }
}

std::vector<Vec3> thinned(std::vector<Vec3> points) {
  std::vector<Vec3> centroids;
  for_each_cube(points, kSpacing_m, [&](std::size_t begin, std::size_t end) {
    Vec3 sum;
    for (std::size_t i = begin; i < end; ++i) sum = sum + points[i];
    centroids.push_back(sum / static_cast<double>(end - begin));
  });
  return centroids;
}

/// The flat part of the samples of a cube, moved to their front: the plane through three of them with most
/// others within the tolerance, refined by least squares. Nothing if it holds less than half of them or is
/// narrow.
std::optional<Patch> flat_part(std::span<Vec3> samples, double side_m, double tolerance_m) {
  std::mt19937 random(1);
  const auto draw = [&] { return samples[random() % samples.size()]; };
  const auto is_near = [&](const Plane& plane) {
    return [&plane, tolerance_m](Vec3 p) { return std::abs(plane.height_m(p)) <= tolerance_m; };
  };
  Plane best;
  std::ptrdiff_t most = 0;
  for (int i = 0; i < kTriples; ++i) {
    const Vec3 a = draw(), normal = cross(draw() - a, draw() - a);
    if (!(norm(normal) > 0.01 * side_m * side_m)) continue;
    const Plane plane{normalized(normal), -dot(normalized(normal), a)};
    const auto count = std::count_if(samples.begin(), samples.end(), is_near(plane));
    if (count > most) most = count, best = plane;
  }
  const auto inliers = [&](const Plane& plane) {
    const auto end = std::partition(samples.begin(), samples.end(), is_near(plane));
    return samples.first(static_cast<std::size_t>(end - samples.begin()));
  };
  if (inliers(best).size() < kLeastSamples) return std::nullopt;
  const PlaneFit fit = fit_plane(inliers(best));
  const std::span<Vec3> flat = inliers(fit.plane);
  if (flat.size() < kLeastSamples || 2 * flat.size() < samples.size() ||
      fit.extent_rms_m < kLeastExtent * side_m)
    return std::nullopt;
  return Patch{0, flat.size(), fit.centroid, fit.plane.normal};
}

}  // namespace

double Surface::area_m2(std::size_t samples) {
  return static_cast<double>(samples) * kSpacing_m * kSpacing_m;
}

Surface sample_surface(std::span<const Vec3> points, double tolerance_m) {
  Surface surface;
  surface.samples = thinned({points.begin(), points.end()});
  for (const double side_m : kPatchSides_m) {
    surface.patches.clear();
    std::size_t dense = 0;
    for_each_cube(surface.samples, side_m, [&](std::size_t begin, std::size_t end) {
      if (end - begin < kLeastSamples) return;
      dense += end - begin;
      if (auto patch =
              flat_part(std::span(surface.samples).subspan(begin, end - begin), side_m, tolerance_m)) {
        patch->begin += begin;
        patch->end += begin;
        surface.patches.push_back(*patch);
      }
    });
    if (2 * dense >= surface.samples.size()) break;  // else the cloud is too sparse for cubes of this size
  }
  return surface;
}

}  // namespace sediment::project2d
