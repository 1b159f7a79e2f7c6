#include <octomap/ColorOcTree.h>

#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <tuple>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/grid_map.hpp"
#include "pipeline/artifacts/octree.hpp"
#include "tools/report/parts.hpp"
#include "tools/report/points_block.hpp"

namespace sediment::report {
namespace {

namespace fs = std::filesystem;

/// The finest depth at which an octree has no more than `limit` occupied nodes.
unsigned depth_within(const octomap::ColorOcTree& tree, std::size_t limit) {
  for (unsigned depth = tree.getTreeDepth(); depth > 1; --depth) {
    std::size_t count = 0;
    for (auto it = tree.begin_leafs(static_cast<unsigned char>(depth)), end = tree.end_leafs(); it != end;
         ++it)
      count += tree.isNodeOccupied(*it) ? 1 : 0;
    if (count <= limit) return depth;
  }
  return 1;
}

using LeafKey = std::tuple<unsigned, unsigned, unsigned>;

/// The most frequent label below each node of a depth; among equals the smallest id.
std::map<LeafKey, std::uint32_t> labels_at(const std::vector<LeafLabel>& leaves, unsigned tree_depth,
                                           unsigned depth) {
  std::map<LeafKey, std::map<std::uint32_t, std::uint64_t>> votes;
  for (const LeafLabel& leaf : leaves) {
    // Keys address cells of the finest level; the upper bits name the node at a coarser one.
    const unsigned shift = tree_depth - std::min<unsigned>(depth, leaf.depth);
    const unsigned below = 3 * (leaf.depth < depth ? 0 : tree_depth - leaf.depth);
    votes[{leaf.key[0] >> shift, leaf.key[1] >> shift, leaf.key[2] >> shift}][leaf.label] += 1ull << below;
  }
  std::map<LeafKey, std::uint32_t> labels;
  for (const auto& [key, counts] : votes) {
    std::uint64_t most = 0;
    for (const auto& [label, count] : counts)
      if (count > most) {
        most = count;
        labels[key] = label;
      }
  }
  return labels;
}

}  // namespace

Json cloud_part(const fs::path& folder, const std::string& id, std::size_t limit, Page& page) {
  const LabelledCloud cloud = read_cloud(folder);
  const auto chosen = spread(limit, cloud.size());
  std::vector<ShownPoint> points;
  for (const std::size_t i : chosen) {
    const LabelledPoint& p = cloud[i];
    points.push_back({{p.x, p.y, p.z}, p.r, p.g, p.b, p.label});
  }
  PointsBlock block = pack(points, read_cloud_labels(folder));
  block.facts["of"] = cloud.size();
  block.facts["block"] =
      page.block("cloud " + id + ' ' + std::to_string(points.size()), [&] { return std::move(block.bytes); });
  return block.facts;
}

Json octree_part(const fs::path& folder, const std::string& id, std::size_t limit, Page& page) {
  const auto tree = read_octree(folder);
  const unsigned deepest = tree->getTreeDepth(), depth = depth_within(*tree, limit);
  const auto labels = labels_at(read_leaf_labels(folder), deepest, depth);
  std::vector<ShownPoint> boxes;
  std::string levels;
  std::size_t of = 0;
  for (auto it = tree->begin_leafs(), end = tree->end_leafs(); it != end; ++it)
    of += tree->isNodeOccupied(*it) ? 1 : 0;
  for (auto it = tree->begin_leafs(static_cast<unsigned char>(depth)), end = tree->end_leafs(); it != end;
       ++it) {
    if (!tree->isNodeOccupied(*it)) continue;
    const octomap::OcTreeKey key = it.getKey();
    const unsigned shift = deepest - it.getDepth();
    const octomap::ColorOcTreeNode::Color color = it->getColor();
    ShownPoint box{{it.getX(), it.getY(), it.getZ()}, color.r, color.g, color.b};
    const LeafKey node{key[0] >> shift, key[1] >> shift, key[2] >> shift};
    if (const auto label = labels.find(node); label != labels.end()) box.label = label->second;
    boxes.push_back(box);
    levels += static_cast<char>(shift);
  }
  PointsBlock block = pack(boxes, read_cloud_labels(folder));
  block.bytes += levels;
  block.facts["of"] = of;
  block.facts["resolution_m"] = tree->getResolution();
  block.facts["level"] = deepest - depth;
  block.facts["block"] =
      page.block("octree " + id + ' ' + std::to_string(depth), [&] { return std::move(block.bytes); });
  return block.facts;
}

Json grid_part(const fs::path& folder, const std::string& id, Page& page) {
  const GridMap map = read_grid_map(folder);
  cv::Mat image(map.height, map.width, CV_8UC1);
  std::size_t free = 0, occupied = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Cell cell = map.at(x, y);
      image.at<std::uint8_t>(map.height - 1 - y, x) = static_cast<std::uint8_t>(cell);
      free += cell == Cell::free ? 1 : 0;
      occupied += cell == Cell::occupied ? 1 : 0;
    }
  const auto png = [&] {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes);
    return std::string(bytes.begin(), bytes.end());
  };
  const auto& r = map.map_from_world.rotation;
  const Vec3 t = map.map_from_world.translation;
  return {{"block", page.block("grid " + id, png)},
          {"width", map.width},
          {"height", map.height},
          {"resolution_m", map.resolution_m},
          {"origin_m", {map.origin_x_m, map.origin_y_m}},
          {"map_from_world", {r[0], r[1], r[2], t.x, r[3], r[4], r[5], t.y, r[6], r[7], r[8], t.z}},
          {"source", map.ground_source},
          {"free", free},
          {"occupied", occupied},
          {"unknown", map.cells.size() - free - occupied}};
}

std::vector<std::size_t> spread(std::size_t count, std::size_t of) {
  count = std::min(count, of);
  std::vector<std::size_t> chosen(count);
  std::uint64_t state =
      0x9e3779b97f4a7c15ull;  // splitmix64: a fixed seed, so that a page is the same each time
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * of / count, end = (i + 1) * of / count;
    std::uint64_t z = state += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    chosen[i] = begin + (z ^ (z >> 31)) % (end - begin);
  }
  return chosen;
}

}  // namespace sediment::report
