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

/// Grey of a leaf that is painted by its label and has none.
constexpr std::uint8_t kNoColor = 160;

/// What is inside a node.
struct Content {
  std::span<const LeafPoint> points;
  std::span<const SpaceCell> cells;  ///< one that is larger than the node belongs to it too

  bool empty() const { return points.empty() && cells.empty(); }
  bool is_inside_one_cell(int depth) const { return cells.size() == 1 && cells.front().depth <= depth; }

  /// What is in the child of a node at `depth`, and removes it from here. Children must be asked for in
  /// order.
  Content take_child(unsigned child, int depth) {
    const int shift = 3 * (kTreeDepth - 1 - depth);
    const auto take = [&](auto& rest) {
      if (rest.empty() || (rest.front().code >> shift & 7) != child) return rest.first(0);
      const auto end = std::partition_point(
          rest.begin(), rest.end(), [&](const auto& item) { return (item.code >> shift & 7) == child; });
      const auto taken = rest.first(static_cast<std::size_t>(end - rest.begin()));
      rest = rest.subspan(taken.size());
      return taken;
    };
    if (is_inside_one_cell(depth)) return {take(points), cells};
    return {take(points), take(cells)};
  }
};

class Builder {
 public:
  Builder(const Parameters& parameters, Occupied occupied, const LabelTable& table)
      : tree_(std::make_unique<RootedTree>(parameters.resolution_m)),
        parameters_(parameters),
        occupied_(occupied),
        table_(table) {}

  SemanticTree build(const Content& all) {
    if (!all.empty()) grow(*tree_->make_root(), all, {}, 0);
    return {std::move(tree_), std::move(leaf_labels_)};
  }

 private:
  /// Makes all below a node from what is inside it, children in the order of their index. `code` is that of
  /// the node's first cell.
  ColorSum grow(ColorOcTreeNode& node, const Content& inside, std::uint64_t code, int depth) {
    if (depth == parameters_.max_depth || (inside.points.empty() && inside.is_inside_one_cell(depth))) {
      node.setLogOdds(log_odds_of(inside));
      return finish(node, inside.points, code, depth);
    }
    const std::size_t first_label = leaf_labels_.size();
    ColorSum sum;
    Content rest = inside;
    for (unsigned child = 0; child < 8; ++child) {
      const Content part = rest.take_child(child, depth);
      if (part.empty()) continue;
      const std::uint64_t child_code = code | static_cast<std::uint64_t>(child)
                                                  << 3 * (kTreeDepth - 1 - depth);
      sum += grow(*tree_->createNodeChild(&node, child), part, child_code, depth + 1);
    }
    if (tree_->pruneNode(&node)) {
      leaf_labels_.resize(first_label);
      return finish(node, inside.points, code, depth);
    }
    node.updateOccupancyChildren();
    if (sum.points > 0) paint(node, sum);
    return sum;
  }

  float log_odds_of(const Content& inside) const {
    if (inside.cells.empty() || (occupied_ == Occupied::by_cloud && !inside.points.empty()))
      return hits(inside.points.size());
    float most = inside.cells.front().log_odds;
    for (const SpaceCell& cell : inside.cells) most = std::max(most, cell.log_odds);
    return most;
  }

  float hits(std::size_t points) const {
    float log_odds = 0;
    for (std::size_t hit = 0; hit < points && log_odds < tree_->getClampingThresMaxLog(); ++hit)
      log_odds = std::min(log_odds + tree_->getProbHitLog(), tree_->getClampingThresMaxLog());
    return log_odds;
  }

  /// Label and colour of a leaf. Free ones have neither.
  ColorSum finish(ColorOcTreeNode& node, std::span<const LeafPoint> points, std::uint64_t code, int depth) {
    if (!tree_->isNodeOccupied(node)) return {};
    const auto beliefs = label_beliefs(points, parameters_.labels);
    add_label(code, depth, beliefs);
    ColorSum sum = sum_of(points);
    if (parameters_.color == LeafColor::label && sum.points > 0) {
      const Label* label = table_.find(beliefs[0].label);
      const auto [r, g, b] = label != nullptr ? label->rgb : std::array{kNoColor, kNoColor, kNoColor};
      sum = {r * sum.points, g * sum.points, b * sum.points, sum.points};
    }
    if (sum.points > 0) paint(node, sum);
    return sum;
  }

  void add_label(std::uint64_t code, int depth, const std::array<LabelBelief, 3>& beliefs) {
    const Keys keys = keys_of(code);
    const octomap::OcTreeKey key =
        tree_->adjustKeyAtDepth({keys.x, keys.y, keys.z}, static_cast<unsigned>(depth));
    LeafLabel leaf{{key[0], key[1], key[2]}, static_cast<std::uint8_t>(depth), beliefs[0].label};
    leaf.confidence = beliefs[0].confidence;
    for (std::size_t i = 0; i < leaf.others.size(); ++i)
      leaf.others[i] = {beliefs[i + 1].label, beliefs[i + 1].confidence};
    leaf_labels_.push_back(leaf);
  }

  std::unique_ptr<RootedTree> tree_;
  std::vector<LeafLabel> leaf_labels_;
  const Parameters& parameters_;
  Occupied occupied_;
  const LabelTable& table_;
};

}  // namespace

SemanticTree build_tree(std::span<const LeafPoint> points, std::span<const SpaceCell> cells,
                        Occupied occupied, const Parameters& parameters, const LabelTable& table) {
  return Builder(parameters, occupied, table).build({points, cells});
}

}  // namespace sediment::octree
