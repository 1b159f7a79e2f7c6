#include "stages/sor/point_tree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace sediment::sor {
namespace {

using Range = tbb::blocked_range<std::size_t>;

std::vector<Box> leaf_boxes(const PointTree& tree) {
  std::vector<Box> boxes(tree.leaf_count());
  tbb::parallel_for(Range(0, boxes.size(), 1 << 10), [&](const Range& range) {
    for (std::size_t leaf = range.begin(); leaf < range.end(); ++leaf)
      for (std::size_t i = tree.leaf_begin(leaf); i < tree.leaf_begin(leaf) + tree.leaf_size(leaf); ++i) {
        boxes[leaf].add(Position{tree.points.x[i], tree.points.y[i], tree.points.z[i]});
      }
  });
  return boxes;
}

std::vector<Box> parent_boxes(const std::vector<Box>& children) {
  std::vector<Box> boxes((children.size() + PointTree::kFanOut - 1) / PointTree::kFanOut);
  for (std::size_t i = 0; i < children.size(); ++i) boxes[i / PointTree::kFanOut].add(children[i]);
  return boxes;
}

/// Gap between two intervals, 0 if they meet.
float gap(float a_min, float a_max, float b_min, float b_max) {
  return std::max(0.0f, std::max(a_min - b_max, b_min - a_max));
}

float squared_distance(const Box& a, const Box& b) {
  const float dx = gap(a.min.x, a.max.x, b.min.x, b.max.x);
  const float dy = gap(a.min.y, a.max.y, b.min.y, b.max.y);
  const float dz = gap(a.min.z, a.max.z, b.min.z, b.max.z);
  return dx * dx + dy * dy + dz * dz;
}

void visit(const PointTree& tree, std::size_t level, std::size_t node, const Box& box, float squared_reach,
           std::vector<std::uint32_t>& leaves) {
  if (squared_distance(tree.levels[level][node], box) > squared_reach) return;
  if (level == 0) {
    leaves.push_back(static_cast<std::uint32_t>(node));
    return;
  }
  const std::size_t first = node * PointTree::kFanOut;
  const std::size_t last = std::min(first + PointTree::kFanOut, tree.levels[level - 1].size());
  for (std::size_t child = first; child < last; ++child)
    visit(tree, level - 1, child, box, squared_reach, leaves);
}

}  // namespace

PointTree build_point_tree(std::span<const Position> points, std::size_t leaf_points) {
  PointTree tree;
  tree.order = spatial_order(points, leaf_points);
  const std::vector<std::uint32_t>& idx = tree.order.point_idx;
  auto& [x, y, z] = tree.points;
  for (auto* axis : {&x, &y, &z}) axis->resize(points.size());
  tbb::parallel_for(Range(0, idx.size(), 1 << 14), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      x[i] = points[idx[i]].x;
      y[i] = points[idx[i]].y;
      z[i] = points[idx[i]].z;
    }
  });
  tree.levels.push_back(leaf_boxes(tree));
  while (tree.levels.back().size() > 1) tree.levels.push_back(parent_boxes(tree.levels.back()));
  return tree;
}

void leaves_near(const PointTree& tree, const Box& box, float distance, std::vector<std::uint32_t>& leaves) {
  if (tree.leaf_count() > 0) visit(tree, tree.levels.size() - 1, 0, box, distance * distance, leaves);
}

}  // namespace sediment::sor
