#include "stages/sor/leaf_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sediment::sor {
namespace {

/// Bounds from the triangle inequality are widened by more than the rounding of the distances they are
/// compared with.
constexpr float kRounding = 1.0f + 1e-5f;
constexpr float kLeast_m = 1e-18f;

/// A group wider than this share of the distance to its neighbours is searched point by point: its candidates
/// would be many.
constexpr float kWideGroup = 1.0f;

float distance(const Position& a, const Position& b) {
  const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

float widened(float reach_m) {
  return reach_m * kRounding + kLeast_m;
}

float squared_limit(float reach_m) {
  const float wide_m = widened(reach_m);
  return std::min(wide_m * wide_m, std::numeric_limits<float>::max());
}

}  // namespace

LeafSearch::Group LeafSearch::group_of(std::size_t begin, std::size_t end, const Box& box) const {
  const Position center{box.min.x + (box.max.x - box.min.x) / 2, box.min.y + (box.max.y - box.min.y) / 2,
                        box.min.z + (box.max.z - box.min.z) / 2};
  return {begin,
          end,
          box,
          center,
          std::max(distance(center, box.min), distance(center, box.max)),
          {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z}};
}

/// An upper bound of the distance from the middle of the group to its (k + 1)-th point, from the points
/// around it in memory.
float LeafSearch::rough_reach_m(std::size_t leaf, const Group& group, Candidates& candidates) const {
  const std::size_t window = std::min(tree_.size, 3 * (k_ + 1) + tree_.leaf_size(leaf));
  const std::size_t middle = group.begin + (group.end - group.begin) / 2;
  const std::size_t first = std::min(middle - std::min(middle, window / 2), tree_.size - window);
  candidates.clear();
  candidates.append(tree_, first, window);
  return shrink(group, candidates);
}

/// An upper bound of the distance from the middle of the group to the (k + 1)-th candidate. Candidates that
/// no point of the group can need are dropped: with r that distance, a point p of the group has its k-th
/// neighbour within r + |p - middle|.
float LeafSearch::shrink(const Group& group, Candidates& candidates) const {
  const Coordinates points = candidates.coordinates();
  const auto& [x, y, z] = group.center;
  const float reach_m = std::sqrt(kernel_.nearest_limit(points, x, y, z, k_ + 1, candidates.scratch()));
  candidates.shrink(kernel_.keep_near(points, x, y, z, squared_limit(reach_m + 2 * group.radius_m)));
  return reach_m;
}

/// Of points at one place no more than the point itself and k neighbours can count.
void LeafSearch::append_leaf(std::size_t leaf, Candidates& candidates) const {
  const std::size_t size = tree_.leaf_size(leaf);
  const bool crowded = size > k_ + 1 && tree_.levels[0].box(leaf).is_point();
  candidates.append(tree_, tree_.leaf_begin(leaf), crowded ? k_ + 1 : size);
}

/// Gathers the points of the eight nodes from `first` on that are within the limit.
void LeafSearch::visit_all(std::size_t level, std::size_t first, const Group& group, float limit,
                           Candidates& candidates) const {
  float squared[PointTree::kFanOut];
  std::uint32_t near =
      kernel_.boxes_near(tree_.levels[level].arrays(), first, group.corners.data(), limit, squared);
  for (; near != 0; near &= near - 1) {
    const std::size_t node = first + static_cast<std::size_t>(std::countr_zero(near));
    if (level > 0)
      visit_all(level - 1, node * PointTree::kFanOut, group, limit, candidates);
    else
      append_leaf(node, candidates);
  }
}

/// The same, nearest nodes first; when the candidates become many, they are thinned out and the reach gets
/// shorter.
void LeafSearch::visit_nearest(std::size_t level, std::size_t first, const Group& group, float& reach_m,
                               std::size_t& room, Candidates& candidates) const {
  const auto limit = [&] { return squared_limit(reach_m + group.radius_m); };
  float squared[PointTree::kFanOut];
  std::uint32_t near =
      kernel_.boxes_near(tree_.levels[level].arrays(), first, group.corners.data(), limit(), squared);
  std::array<std::size_t, PointTree::kFanOut> order;
  std::size_t count = 0;
  for (; near != 0; near &= near - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(near));
    std::size_t place = count++;
    for (; place > 0 && squared[order[place - 1]] > squared[i]; --place) order[place] = order[place - 1];
    order[place] = i;
  }
  for (std::size_t i = 0; i < count && squared[order[i]] <= limit(); ++i) {
    const std::size_t node = first + order[i];
    if (level > 0) {
      visit_nearest(level - 1, node * PointTree::kFanOut, group, reach_m, room, candidates);
      continue;
    }
    append_leaf(node, candidates);
    if (candidates.size() < room) continue;
    reach_m = std::min(reach_m, shrink(group, candidates));
    room = std::max(room, 2 * candidates.size());
  }
}

/// Leaves the candidates of the group, and returns an upper bound of the distance from its middle to the (k +
/// 1)-th point. A single point was alone in a wide leaf, far from everything: its reach is rough, and is
/// narrowed on the way.
float LeafSearch::gather(const Group& group, float reach_m, Candidates& candidates) const {
  candidates.clear();
  std::size_t room = 4 * (k_ + 1);
  const std::size_t top = tree_.levels.size() - 1;
  if (group.end - group.begin > 1)
    visit_all(top, 0, group, squared_limit(reach_m + group.radius_m), candidates);
  else
    visit_nearest(top, 0, group, reach_m, room, candidates);
  return shrink(group, candidates);
}

void LeafSearch::run(const Group& group, float reach_m, Candidates& candidates,
                     std::span<float> means_m) const {
  const float center_reach_m = gather(group, reach_m, candidates);
  const Coordinates points = candidates.coordinates();
  const bool one_place = group.box.is_point();
  Position last = group.center;
  float last_reach_m = center_reach_m, mean_m = 0;
  for (std::size_t i = group.begin; i < group.end; ++i) {
    if (i == group.begin || !one_place) {
      const Position at = tree_.point(i);
      const float bound_m =
          std::min(last_reach_m + distance(at, last), center_reach_m + distance(at, group.center));
      // k + 1: the point itself is the nearest, at distance 0.
      const Nearest found =
          kernel_.nearest(points, at.x, at.y, at.z, k_ + 1, squared_limit(bound_m), candidates.scratch());
      last = at;
      last_reach_m = std::sqrt(found.squared_distance);
      mean_m = static_cast<float>(found.distance_sum / static_cast<double>(k_));
    }
    means_m[tree_.order.point_idx[i]] = mean_m;
  }
}

void LeafSearch::run(std::size_t leaf, Candidates& candidates, std::span<float> means_m) const {
  const std::size_t begin = tree_.leaf_begin(leaf), end = begin + tree_.leaf_size(leaf);
  const Group whole = group_of(begin, end, tree_.levels[0].box(leaf));
  const float reach_m = rough_reach_m(leaf, whole, candidates);
  if (whole.radius_m <= kWideGroup * reach_m) return run(whole, reach_m, candidates, means_m);
  for (std::size_t i = begin; i < end; ++i) {
    const Position at = tree_.point(i);
    run(group_of(i, i + 1, {at, at}), reach_m + distance(at, whole.center), candidates, means_m);
  }
}

}  // namespace sediment::sor
