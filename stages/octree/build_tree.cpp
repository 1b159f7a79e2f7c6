#include "stages/octree/build_tree.hpp"

#include <octomap/ColorOcTree.h>

#include <algorithm>

namespace sediment::octree {
namespace {

using octomap::ColorOcTree;
using octomap::ColorOcTreeNode;

/// Gives access to the root of an empty tree, which OctoMap itself creates with the first point only.
struct RootedTree : ColorOcTree {
  using ColorOcTree::ColorOcTree;
  ColorOcTreeNode* make_root() {
    root = new ColorOcTreeNode();
    ++tree_size;
    size_changed = true;
    return root;
  }
};

/// Sums over the points of a node: exact.
struct ColorSum {
  std::uint64_t r = 0, g = 0, b = 0, points = 0;
  ColorSum& operator+=(const ColorSum& other) {
    r += other.r;
    g += other.g;
    b += other.b;
    points += other.points;
    return *this;
  }
};

ColorSum sum_of(std::span<const LeafPoint> points) {
  ColorSum sum;
  for (const LeafPoint& point : points) sum += {point.r, point.g, point.b, 1};
  return sum;
}

void paint(ColorOcTreeNode& node, const ColorSum& sum) {
  const auto mean = [&](std::uint64_t channel) {
    return static_cast<std::uint8_t>((2 * channel + sum.points) / (2 * sum.points));
  };
  node.setColor(mean(sum.r), mean(sum.g), mean(sum.b));
}

struct LabelCount {
  std::uint32_t label = kUnlabelled;
  std::size_t points = 0;
};

class Builder {
 public:
  explicit Builder(const Parameters& parameters)
      : tree_(std::make_unique<RootedTree>(parameters.resolution_m)), max_depth_(parameters.max_depth) {}

  SemanticTree build(std::span<const LeafPoint> sorted) {
    if (!sorted.empty()) grow(*tree_->make_root(), sorted, 0);
    return {std::move(tree_), std::move(leaf_labels_)};
  }

 private:
  /// Makes all below a node from the points inside it, children in the order of their index.
  ColorSum grow(ColorOcTreeNode& node, std::span<const LeafPoint> points, int depth) {
    if (depth == max_depth_) return finish_leaf(node, points);
    const std::size_t first_label = leaf_labels_.size();
    const int shift = 3 * (kTreeDepth - 1 - depth);
    ColorSum sum;
    for (auto rest = points; !rest.empty();) {
      const unsigned child = rest.front().code >> shift & 7;
      const auto end = std::partition_point(
          rest.begin(), rest.end(), [&](const LeafPoint& p) { return (p.code >> shift & 7) == child; });
      const auto inside = rest.first(static_cast<std::size_t>(end - rest.begin()));
      sum += grow(*tree_->createNodeChild(&node, child), inside, depth + 1);
      rest = rest.subspan(inside.size());
    }
    if (tree_->pruneNode(&node)) {
      leaf_labels_.resize(first_label);
      add_label(points, depth);
    } else {
      node.updateOccupancyChildren();
    }
    paint(node, sum);
    return sum;
  }

  ColorSum finish_leaf(ColorOcTreeNode& node, std::span<const LeafPoint> points) {
    float log_odds = 0;
    for (std::size_t hit = 0; hit < points.size() && log_odds < tree_->getClampingThresMaxLog(); ++hit)
      log_odds = std::min(log_odds + tree_->getProbHitLog(), tree_->getClampingThresMaxLog());
    node.setLogOdds(log_odds);
    const ColorSum sum = sum_of(points);
    paint(node, sum);
    add_label(points, max_depth_);
    return sum;
  }

  std::uint32_t majority_label(std::span<const LeafPoint> points) {
    counts_.clear();
    for (const LeafPoint& point : points) {
      const auto known = std::find_if(counts_.begin(), counts_.end(),
                                      [&](const LabelCount& count) { return count.label == point.label; });
      if (known == counts_.end())
        counts_.push_back({point.label, 1});
      else
        ++known->points;
    }
    return std::min_element(counts_.begin(), counts_.end(),
                            [](const LabelCount& a, const LabelCount& b) {
                              return a.points != b.points ? a.points > b.points : a.label < b.label;
                            })
        ->label;
  }

  void add_label(std::span<const LeafPoint> points, int depth) {
    const Keys keys = keys_of(points.front().code);
    const octomap::OcTreeKey key =
        tree_->adjustKeyAtDepth({keys.x, keys.y, keys.z}, static_cast<unsigned>(depth));
    leaf_labels_.push_back(
        {{key[0], key[1], key[2]}, static_cast<std::uint8_t>(depth), majority_label(points)});
  }

  std::unique_ptr<RootedTree> tree_;
  std::vector<LeafLabel> leaf_labels_;
  std::vector<LabelCount> counts_;
  int max_depth_;
};

}  // namespace

SemanticTree build_tree(std::span<const LeafPoint> sorted, const Parameters& parameters) {
  return Builder(parameters).build(sorted);
}

}  // namespace sediment::octree
