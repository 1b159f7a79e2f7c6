#include "stages/carve/point_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipeline/sorting/radix_sort.hpp"

namespace sediment::carve {
namespace {

constexpr double kCell_m = 0.25;
constexpr std::size_t kMostPoints = 1024;  ///< of a block

/// 21 bits an axis; cells that are further apart than that share a key, which costs time and no more.
std::uint64_t cell_of(const LabelledPoint& point) {
  const auto part = [](float value) {
    const double cell = std::floor(static_cast<double>(value) / kCell_m);
    return std::isfinite(cell)
               ? static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(cell, -1e15, 1e15))) &
                     ((std::uint64_t{1} << 21) - 1)
               : 0;
  };
  return part(point.x) | part(point.y) << 21 | part(point.z) << 42;
}

Block block_of(const LabelledCloud& points, std::size_t begin, std::size_t end) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 least{kInfinity, kInfinity, kInfinity}, most{-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = begin; i < end; ++i) {
    const LabelledPoint& p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    least = {std::min<double>(least.x, p.x), std::min<double>(least.y, p.y), std::min<double>(least.z, p.z)};
    most = {std::max<double>(most.x, p.x), std::max<double>(most.y, p.y), std::max<double>(most.z, p.z)};
  }
  // Nothing finite: the radius is NaN, and the block is in no frustum.
  return {begin, end, 0.5 * (least + most), 0.5 * norm(most - least) + 1e-6};
}

}  // namespace

Frustum frustum_of(const Camera& camera, double min_depth_m, double max_depth_m) {
  Frustum frustum{min_depth_m, max_depth_m, {1e300, -1e300}, {1e300, -1e300}};
  const auto add = [&](double u, double v) {
    const Pixel ray = camera.undistort({u, v});
    frustum.x = {std::min(frustum.x[0], ray.u), std::max(frustum.x[1], ray.u)};
    frustum.y = {std::min(frustum.y[0], ray.v), std::max(frustum.y[1], ray.v)};
  };
  // A pixel more on all sides: the outermost pixels, and what lies between those of the border.
  for (int u = -1; u <= camera.width; ++u) add(u, -1), add(u, camera.height);
  for (int v = -1; v <= camera.height; ++v) add(-1, v), add(camera.width, v);
  return frustum;
}

bool Block::may_be_in(const Frustum& frustum, const Pose& camera_from_world) const {
  const Vec3 c = camera_from_world * centre_m;
  // Of a plane x = slope z the distance of the centre, on the side of larger x.
  const auto beyond = [&](double along, double slope) {
    return (along - slope * c.z) / std::sqrt(1 + slope * slope);
  };
  return c.z + radius_m >= frustum.min_depth_m && c.z - radius_m <= frustum.max_depth_m &&
         beyond(c.x, frustum.x[0]) >= -radius_m && beyond(c.x, frustum.x[1]) <= radius_m &&
         beyond(c.y, frustum.y[0]) >= -radius_m && beyond(c.y, frustum.y[1]) <= radius_m;
}

PointBlocks blocks_of(const LabelledCloud& cloud) {
  if (cloud.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("carve: more than 2^32 points");
  PointBlocks sorted;
  std::vector<std::uint64_t> keys;
  keys.reserve(cloud.size());
  for (const LabelledPoint& point : cloud) keys.push_back(cell_of(point));
  sorted.order.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) sorted.order[i] = static_cast<std::uint32_t>(i);
  sort_by_key(keys, sorted.order, 63);
  sorted.points.reserve(cloud.size());
  for (const std::uint32_t i : sorted.order) sorted.points.push_back(cloud[i]);
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    while (end < keys.size() && keys[end] == keys[begin] && end - begin < kMostPoints) ++end;
    sorted.blocks.push_back(block_of(sorted.points, begin, end));
  }
  return sorted;
}

}  // namespace sediment::carve
