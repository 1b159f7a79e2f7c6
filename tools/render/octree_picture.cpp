#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/octree.hpp"
#include "tools/render/annotation.hpp"
#include "tools/render/canvas.hpp"
#include "tools/render/pictures.hpp"

namespace sediment::render {
namespace {

struct Leaf {
  Vec3 center;
  double side_m;
  cv::Vec3b bgr;
  std::uint32_t label = kUnlabelled;
};

using LeafKey = std::tuple<std::uint16_t, std::uint16_t, std::uint16_t, unsigned>;

std::vector<Leaf> leaves_of(const std::filesystem::path& folder, int max_depth, const Pose& map_from_world,
                            double max_height_m) {
  const auto tree = read_octree(folder);
  std::map<LeafKey, std::uint32_t> labels;
  for (const LeafLabel& leaf : read_leaf_labels(folder))
    labels[{leaf.key[0], leaf.key[1], leaf.key[2], leaf.depth}] = leaf.label;
  std::vector<Leaf> leaves;
  for (auto it = tree->begin_leafs(static_cast<unsigned char>(max_depth)), end = tree->end_leafs(); it != end;
       ++it) {
    if (!tree->isNodeOccupied(*it)) continue;
    const octomap::OcTreeKey key = it.getIndexKey();
    const octomap::ColorOcTreeNode::Color color = it->getColor();
    Leaf leaf{{it.getX(), it.getY(), it.getZ()}, it.getSize(), {color.b, color.g, color.r}};
    if (const auto label = labels.find({key[0], key[1], key[2], it.getDepth()}); label != labels.end())
      leaf.label = label->second;
    if (max_height_m <= 0 || (map_from_world * leaf.center).z <= max_height_m) leaves.push_back(leaf);
  }
  return leaves;
}

std::vector<LegendEntry> legend_of(const std::vector<Leaf>& leaves) {
  std::map<std::uint32_t, std::size_t> counts;
  for (const Leaf& leaf : leaves) ++counts[leaf.label];
  std::vector<std::pair<std::size_t, std::uint32_t>> order;
  for (const auto& [label, count] : counts) order.emplace_back(count, label);
  std::sort(order.rbegin(), order.rend());
  std::vector<LegendEntry> entries;
  for (const auto& [count, id] : order)
    if (const Label* label = default_labels().find(id))
      entries.push_back({{label->rgb[2], label->rgb[1], label->rgb[0]}, label->name});
  if (counts.contains(kUnlabelled)) entries.push_back({{150, 150, 150}, "unlabelled"});
  return entries;
}

}  // namespace

cv::Mat octree_picture(const std::filesystem::path& folder, int max_depth, const MapOptions& options) {
  const Pose to_map = map_from_world(options.ground, options.up);
  const Vec3 up = to_map.inverse().rotate({0, 0, 1});
  const std::vector<Leaf> leaves = leaves_of(folder, max_depth, to_map, options.max_height_m);
  std::vector<Vec3> centers(leaves.size());
  std::vector<double> heights_m(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    centers[i] = leaves[i].center;
    heights_m[i] = (to_map * leaves[i].center).z;
  }
  const HeightRange range = height_range(heights_m);
  const View view = fit_view(centers, to_map, options.view);
  Canvas canvas(view);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const Leaf& leaf = leaves[i];
    const cv::Vec3b bgr = options.color == ColorBy::image ? leaf.bgr
                          : options.color == ColorBy::label
                              ? label_color(leaf.label, leaf.bgr, default_labels())
                              : scale_color(range.share(heights_m[i]));
    canvas.cube(leaf.center, leaf.side_m, bgr, up);
  }
  cv::Mat picture = canvas.shaded(0.6 * options.shading);
  add_title(picture, options.title);
  if (!view.perspective) add_scale_bar(picture, view.scale);
  if (options.color == ColorBy::label) add_legend(picture, legend_of(leaves));
  if (options.color == ColorBy::height) add_height_scale(picture, range);
  return picture;
}

}  // namespace sediment::render
