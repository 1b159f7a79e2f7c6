#include "stages/sor/point_tree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace sediment::sor {
namespace {

using Range = tbb::blocked_range<std::size_t>;

/// A level of `count` boxes; `box_of(i)` makes the i-th.
template <class BoxOf>
PointTree::Level make_level(std::size_t count, BoxOf box_of) {
  PointTree::Level level;
  const std::size_t padded = (count + PointTree::kFanOut - 1) / PointTree::kFanOut * PointTree::kFanOut;
  const Box empty;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    level.min[axis].assign(padded, empty.min.x);
    level.max[axis].assign(padded, empty.max.x);
  }
  tbb::parallel_for(Range(0, count, 1 << 10), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Box box = box_of(i);
      level.min[0][i] = box.min.x, level.min[1][i] = box.min.y, level.min[2][i] = box.min.z;
      level.max[0][i] = box.max.x, level.max[1][i] = box.max.y, level.max[2][i] = box.max.z;
    }
  });
  return level;
}

Box leaf_box(const PointTree& tree, std::size_t leaf) {
  Box box;
  for (std::size_t i = 0; i < tree.leaf_size(leaf); ++i) box.add(tree.point(tree.leaf_begin(leaf) + i));
  return box;
}

Box parent_box(const PointTree::Level& children, std::size_t node) {
  Box box;
  for (std::size_t i = 0; i < PointTree::kFanOut; ++i) box.add(children.box(node * PointTree::kFanOut + i));
  return box;
}

}  // namespace

PointTree build_point_tree(std::span<const Position> points, std::size_t leaf_points) {
  PointTree tree;
  tree.size = points.size();
  tree.order = spatial_order(points, leaf_points);
  const std::vector<std::uint32_t>& idx = tree.order.point_idx;
  for (auto& axis : tree.axes) axis.resize(points.size() + PointTree::kPadding);
  tbb::parallel_for(Range(0, idx.size(), 1 << 14), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Position& p = points[idx[i]];
      tree.axes[0][i] = p.x, tree.axes[1][i] = p.y, tree.axes[2][i] = p.z;
    }
  });
  if (tree.leaf_count() == 0) return tree;
  tree.levels.push_back(
      make_level(tree.leaf_count(), [&](std::size_t leaf) { return leaf_box(tree, leaf); }));
  for (std::size_t count = tree.leaf_count(); count > 1;) {
    count = (count + PointTree::kFanOut - 1) / PointTree::kFanOut;
    const PointTree::Level& children = tree.levels.back();
    tree.levels.push_back(make_level(count, [&](std::size_t node) { return parent_box(children, node); }));
  }
  return tree;
}

}  // namespace sediment::sor
