#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "stages/project2d/plane_search.hpp"

namespace sediment::project2d {
namespace {

constexpr double kColumn_m = 0.05;
/// What reaches up to this many tolerances stands on the layer.
constexpr double kAbove = 4;
/// Shares of the tolerance, round by round: what crosses the layer or lies on it is let go bit by bit.
constexpr double kShares[] = {1, 0.8, 0.6, 0.5, 0.4, 0.33, 0.33, 0.33};

/// Which column a point of the layer's frame stands in: x and y in the upper and lower half.
std::uint64_t column_of(Vec3 p) {
  const auto index = [](double value) {
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(std::clamp(std::floor(value / kColumn_m), -2e9, 2e9)));
  };
  return std::uint64_t{index(p.x)} << 32 | index(p.y);
}

/// The points within the tolerance of z = 0, one for each column. Columns that go on above are left out: the
/// foot of a wall fills any layer, its mean height is always that of the plane, and it would hold a wrong
/// plane in its place.
std::vector<Vec3> columns_of(std::span<const Vec3> points, const Pose& layer_from_world, double tolerance_m) {
  std::vector<Vec3> near;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (const Vec3 point : points) {
    const Vec3 p = layer_from_world * point;
    if (p.z < -tolerance_m || p.z > kAbove * tolerance_m) continue;
    order.emplace_back(column_of(p), static_cast<std::uint32_t>(near.size()));
    near.push_back(p);
  }
  std::sort(order.begin(), order.end());
  std::vector<Vec3> columns;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    Vec3 sum;
    std::size_t within = 0;
    for (end = begin; end < order.size() && order[end].first == order[begin].first; ++end) {
      const Vec3 p = near[order[end].second];
      if (p.z > tolerance_m) continue;
      sum = sum + p;
      ++within;
    }
    if (within > 2 * (end - begin - within)) columns.push_back(sum / static_cast<double>(within));
  }
  return columns;
}

/// The points that can be in the layer or just above it in some round.
std::vector<Vec3> points_around(std::span<const Vec3> points, const Plane& plane, double tolerance_m) {
  std::vector<Vec3> around;
  std::copy_if(points.begin(), points.end(), std::back_inserter(around),
               [&](Vec3 p) { return std::abs(plane.height_m(p)) <= 2 * kAbove * tolerance_m; });
  return around;
}

}  // namespace

Layer fit_layer(std::span<const Vec3> points, Plane plane, double tolerance_m) {
  Layer layer{plane, -plane.offset_m * plane.normal};
  const std::vector<Vec3> around = points_around(points, plane, tolerance_m);
  for (const double share : kShares) {
    const Pose layer_from_world = map_from_world(layer.plane);
    std::vector<Vec3> columns = columns_of(around, layer_from_world, tolerance_m);
    layer.area_m2 = static_cast<double>(columns.size()) * kColumn_m * kColumn_m;
    std::erase_if(columns, [&](Vec3 p) { return std::abs(p.z) > share * tolerance_m; });
    if (columns.size() < 3) return layer;
    const PlaneFit fit = fit_plane(columns);
    const Plane fitted = fit.plane.normal.z < 0 ? fit.plane.flipped() : fit.plane;
    layer.rms_m = fit.rms_m;
    layer.center = layer_from_world.inverse() * fit.centroid;
    layer.plane = {layer_from_world.inverse().rotate(fitted.normal),
                   fitted.offset_m + dot(fitted.normal, layer_from_world.translation)};
  }
  return layer;
}

}  // namespace sediment::project2d
