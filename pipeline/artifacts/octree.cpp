#include "pipeline/artifacts/octree.hpp"

#include <octomap/ColorOcTree.h>

#include <charconv>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/label_csv.hpp"
#include "pipeline/artifacts/text_table.hpp"

namespace sediment {
namespace {

/// A node in a .ot file: log-odds as float, three bytes of colour, one byte of children.
constexpr std::uint64_t kNodeBytes = 8;

void write_stream(const std::filesystem::path& file, const std::function<bool(std::ostream&)>& write) {
  std::ofstream stream(file, std::ios::binary);
  const bool written = stream && write(stream);
  stream.close();
  if (!written || !stream) throw std::runtime_error("cannot write " + file.string());
}

/// OctoMap's own reader runs wild on a file that is cut off, so the header is checked against the size first.
void check_whole(const std::string& content, const std::string& name) {
  std::istringstream stream(content);
  std::string line, id;
  std::uint64_t nodes = 0;
  std::getline(stream, line);
  if (!line.starts_with("# Octomap OcTree file"))
    throw std::runtime_error(name + ": not an OctoMap tree (.ot)");
  while (std::getline(stream, line) && line != "data") {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "id") words >> id;
    if (key == "size") words >> nodes;
  }
  if (line != "data") throw std::runtime_error(name + ": truncated header");
  if (id != "ColorOcTree") throw std::runtime_error(name + ": expected a ColorOcTree, found \"" + id + "\"");
  const std::uint64_t found = content.size() - static_cast<std::uint64_t>(stream.tellg());
  if (found != nodes * kNodeBytes)
    throw std::runtime_error(name + ": truncated: " + std::to_string(nodes) + " nodes need " +
                             std::to_string(nodes * kNodeBytes) + " bytes, " + std::to_string(found) +
                             " found");
}

std::string leaf_label_text(const std::vector<LeafLabel>& leaf_labels) {
  std::string text = "key_x,key_y,key_z,depth,label\n";
  char buffer[16];
  const auto append = [&](std::uint32_t value, char end) {
    text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
    text.push_back(end);
  };
  for (const LeafLabel& leaf : leaf_labels) {
    for (const std::uint16_t key : leaf.key) append(key, ',');
    append(leaf.depth, ',');
    append(leaf.label, '\n');
  }
  return text;
}

}  // namespace

void write_octree(const std::filesystem::path& folder, octomap::ColorOcTree& tree,
                  const std::vector<LeafLabel>& leaf_labels, const LabelTable& labels) {
  std::filesystem::create_directories(folder);
  write_stream(folder / "map.ot", [&](std::ostream& stream) { return tree.write(stream); });
  write_bytes(folder / "leaf_labels.csv", {leaf_label_text(leaf_labels)});
  std::set<std::uint32_t> present;
  for (const LeafLabel& leaf : leaf_labels) present.insert(leaf.label);
  write_label_csv(folder / "labels.csv", labels, present);
  // Last, as it rounds the tree to occupied and free and prunes it.
  write_stream(folder / "map.bt", [&](std::ostream& stream) { return tree.writeBinary(stream); });
}

std::unique_ptr<octomap::ColorOcTree> read_octree(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "map.ot";
  const std::string content = read_bytes(file);
  check_whole(content, file.string());
  std::istringstream stream(content);
  std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::read(stream));
  auto* color_tree = dynamic_cast<octomap::ColorOcTree*>(tree.get());
  if (color_tree == nullptr || !stream) throw std::runtime_error(file.string() + ": damaged tree");
  tree.release();
  return std::unique_ptr<octomap::ColorOcTree>(color_tree);
}

std::vector<LeafLabel> read_leaf_labels(const std::filesystem::path& folder) {
  std::vector<LeafLabel> leaf_labels;
  read_rows(folder / "leaf_labels.csv", [&](const TextRow& row) {
    if (row.line == 1 && row.columns[0] == "key_x") return;
    if (row.columns.size() != 5)
      throw std::runtime_error("expected 5 columns, found " + std::to_string(row.columns.size()));
    LeafLabel leaf;
    for (int i = 0; i < 3; ++i)
      leaf.key[i] = static_cast<std::uint16_t>(expect_whole(row.columns[i], "a key", 65535));
    leaf.depth = static_cast<std::uint8_t>(expect_whole(row.columns[3], "depth", 16));
    leaf.label = static_cast<std::uint32_t>(expect_whole(row.columns[4], "label", UINT32_MAX));
    leaf_labels.push_back(leaf);
  });
  return leaf_labels;
}

}  // namespace sediment
