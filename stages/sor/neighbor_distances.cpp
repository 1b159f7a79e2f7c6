#include "stages/sor/neighbor_distances.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "stages/sor/distance_selection.hpp"
#include "stages/sor/point_tree.hpp"

namespace sediment::sor {
namespace {

constexpr std::size_t kLeafPoints = 16;

/// Bounds from the triangle inequality are widened by more than the rounding of the distances they are
/// compared with.
constexpr float kRounding = 1.0f + 1e-5f;

/// What a thread keeps between leaves.
struct Workspace {
  Candidates window, candidates;
  std::vector<std::uint32_t> leaves;
  std::vector<float> scratch;
};

Position center_of(const Box& box) {
  return {box.min.x + (box.max.x - box.min.x) / 2, box.min.y + (box.max.y - box.min.y) / 2,
          box.min.z + (box.max.z - box.min.z) / 2};
}

float distance(const Position& a, const Position& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// No point of the leaf has its k-th neighbour further away than this. Some k + 1 points lie within the
/// distance r of the middle of the leaf; then each of its points p has k neighbours within r + |p - middle|.
/// Points around the leaf in memory give such an r.
float reach_of(const PointTree& tree, std::size_t leaf, std::size_t k, Workspace& work) {
  const std::size_t size = tree.points.x.size();
  const std::size_t window = std::min(size, 3 * (k + 1) + tree.leaf_size(leaf));
  if (window <= k) return INFINITY;
  const std::size_t middle = tree.leaf_begin(leaf) + tree.leaf_size(leaf) / 2;
  const std::size_t first = std::min(middle - std::min(middle, window / 2), size - window);
  work.window.clear();
  work.window.append(&tree.points.x[first], &tree.points.y[first], &tree.points.z[first], window);
  const Box& box = tree.levels[0][leaf];
  const Position center = center_of(box);
  const float radius = std::max(distance(center, box.min), distance(center, box.max));
  const float squared = nearest(work.window, center, k + 1, work.scratch).squared_distance;
  return (std::sqrt(squared) + radius) * kRounding + std::numeric_limits<float>::min();
}

/// All points that can be among the k nearest of any point of the leaf.
void gather(const PointTree& tree, std::size_t leaf, std::size_t k, Workspace& work) {
  work.leaves.clear();
  leaves_near(tree, tree.levels[0][leaf], reach_of(tree, leaf, k, work), work.leaves);
  work.candidates.clear();
  for (const std::uint32_t near : work.leaves) {
    const std::size_t begin = tree.leaf_begin(near);
    // Of points at one place no more than the point itself and k neighbours can count.
    const std::size_t count =
        tree.levels[0][near].is_point() ? std::min(tree.leaf_size(near), k + 1) : tree.leaf_size(near);
    work.candidates.append(&tree.points.x[begin], &tree.points.y[begin], &tree.points.z[begin], count);
  }
}

}  // namespace

std::vector<float> mean_neighbor_distances(std::span<const Position> points, std::size_t k) {
  std::vector<float> means(points.size(), 0.0f);
  const std::size_t neighbors = std::min(k, points.size() - std::min<std::size_t>(points.size(), 1));
  if (neighbors == 0) return means;
  const PointTree tree = build_point_tree(points, kLeafPoints);
  tbb::enumerable_thread_specific<Workspace> workspaces;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.leaf_count(), 64), [&](const auto& range) {
    Workspace& work = workspaces.local();
    for (std::size_t leaf = range.begin(); leaf < range.end(); ++leaf) {
      gather(tree, leaf, neighbors, work);
      const bool one_place = tree.levels[0][leaf].is_point();
      float mean = 0;
      for (std::size_t i = 0; i < tree.leaf_size(leaf); ++i) {
        const std::size_t at = tree.leaf_begin(leaf) + i;
        // The point itself is the nearest, at distance 0.
        if (i == 0 || !one_place) {
          const Position point{tree.points.x[at], tree.points.y[at], tree.points.z[at]};
          const double sum = nearest(work.candidates, point, neighbors + 1, work.scratch).distance_sum;
          mean = static_cast<float>(sum / static_cast<double>(neighbors));
        }
        means[tree.order.point_idx[at]] = mean;
      }
    }
  });
  return means;
}

}  // namespace sediment::sor
