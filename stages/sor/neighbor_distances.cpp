#include "stages/sor/neighbor_distances.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "stages/sor/leaf_search.hpp"

namespace sediment::sor {
namespace {

/// Leaves of about half as many points as neighbours cost least: smaller ones share too little, larger ones
/// gather too much.
std::size_t leaf_points_for(std::size_t k) {
  return std::clamp<std::size_t>(k / 2, 8, 256);
}

}  // namespace

std::vector<float> mean_neighbor_distances(std::span<const Position> points, std::size_t k,
                                           const NearestKernel& kernel) {
  std::vector<float> means_m(points.size(), 0.0f);
  if (points.size() < 2 || k == 0) return means_m;
  const PointTree tree = build_point_tree(points, leaf_points_for(k));
  const LeafSearch search(tree, std::min(k, points.size() - 1), kernel);
  tbb::enumerable_thread_specific<Candidates> candidates;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.leaf_count(), 64), [&](const auto& range) {
    Candidates& own = candidates.local();
    for (std::size_t leaf = range.begin(); leaf < range.end(); ++leaf) search.run(leaf, own, means_m);
  });
  return means_m;
}

}  // namespace sediment::sor
