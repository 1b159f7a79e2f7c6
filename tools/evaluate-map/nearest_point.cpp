#include "tools/evaluate-map/nearest_point.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sediment::tools {
namespace {

constexpr std::size_t kLeaf = 12;  ///< points of a range that is not split any more

double along(Vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

}  // namespace

NearestPoint::NearestPoint(std::vector<Vec3> points)
    : points_(std::move(points)), given_idx_(points_.size()), axis_(points_.size(), 0) {
  std::iota(given_idx_.begin(), given_idx_.end(), 0u);
  build(0, given_idx_.size());
  std::vector<Vec3> in_order(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) in_order[i] = points_[given_idx_[i]];
  points_ = std::move(in_order);
}

void NearestPoint::build(std::size_t begin, std::size_t end) {
  if (end - begin <= kLeaf) return;
  Vec3 low = points_[given_idx_[begin]], high = low;
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3 p = points_[given_idx_[i]];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return given_idx_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return along(points_[a], axis) < along(points_[b], axis);
  });
  axis_[middle] = static_cast<std::uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

NearestPoint::Found NearestPoint::find_from(Vec3 query, std::size_t tree_idx) const {
  const Vec3 to = points_[tree_idx] - query;
  Found best{given_idx_[tree_idx], dot(to, to), tree_idx};  // the distance is squared until the end
  search(0, points_.size(), query, best);
  best.distance_m = std::sqrt(best.distance_m);
  return best;
}

NearestPoint::Found NearestPoint::find(Vec3 query) const {
  return find_from(query, points_.size() / 2);
}

std::vector<NearestPoint::Found> NearestPoint::find_all(const std::vector<Vec3>& queries) const {
  std::vector<Found> found(queries.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), 4096), [&](const auto& range) {
    // What was found last is an upper bound that cuts most of the tree off; the result does not depend on it.
    std::size_t last = points_.size() / 2;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      found[i] = find_from(queries[i], last);
      last = found[i].tree_idx;
    }
  });
  return found;
}

bool NearestPoint::has_within(Vec3 query, double radius_m) const {
  // The search looks for something nearer than what it has, or as near with a smaller index.
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  Found best{kNone, radius_m * radius_m, 0};
  search(0, points_.size(), query, best);
  return best.point_idx != kNone;
}

void NearestPoint::search(std::size_t begin, std::size_t end, Vec3 query, Found& best) const {
  const auto look_at = [&](std::size_t i) {
    const Vec3 to = points_[i] - query;
    const double squared = dot(to, to);
    if (squared < best.distance_m || (squared == best.distance_m && given_idx_[i] < best.point_idx))
      best = {given_idx_[i], squared, i};
  };
  if (end - begin <= kLeaf) {
    for (std::size_t i = begin; i < end; ++i) look_at(i);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const double beyond = along(query, axis_[middle]) - along(points_[middle], axis_[middle]);
  look_at(middle);
  if (beyond < 0)
    search(begin, middle, query, best);
  else
    search(middle + 1, end, query, best);
  if (beyond * beyond > best.distance_m) return;
  if (beyond < 0)
    search(middle + 1, end, query, best);
  else
    search(begin, middle, query, best);
}

}  // namespace sediment::tools
