#include "pipeline/artifacts/octree.hpp"

#include <octomap/ColorOcTree.h>

#include <charconv>
#include <cmath>
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
constexpr const char* kTreeLine = "# Octomap OcTree file";

/// Writes a tree as OctoMap does (AbstractOcTree::write and writeBinary), whose own functions talk on stderr.
void write_tree(const std::filesystem::path& file, const char* first_line, const octomap::ColorOcTree& tree,
                const std::function<void(std::ostream&)>& write_nodes) {
  std::ofstream stream(file, std::ios::binary);
  stream << first_line << "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
         << "id " << tree.getTreeType() << "\nsize " << tree.size() << "\nres " << tree.getResolution()
         << "\ndata\n";
  if (stream) write_nodes(stream);
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

/// What stands before the nodes in a .ot file.
struct TreeHeader {
  double resolution_m = 0;
  std::uint64_t nodes = 0;
};

/// OctoMap's own reader runs wild on a file that is cut off, so the size is checked first. Leaves the stream
/// at the first node.
TreeHeader read_header(std::istringstream& stream, std::uint64_t content_bytes) {
  TreeHeader header;
  std::string line, id;
  std::getline(stream, line);
  if (!line.starts_with(kTreeLine)) throw std::runtime_error("not an OctoMap tree (.ot)");
  while (std::getline(stream, line) && line != "data") {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "id") words >> id;
    if (key == "size") words >> header.nodes;
    if (key == "res") words >> header.resolution_m;
  }
  if (line != "data") throw std::runtime_error("truncated header");
  if (id != "ColorOcTree") throw std::runtime_error("expected a ColorOcTree, found \"" + id + "\"");
  if (!(header.resolution_m > 0)) throw std::runtime_error("damaged header: no resolution");
  const std::uint64_t found = content_bytes - static_cast<std::uint64_t>(stream.tellg());
  if (found != header.nodes * kNodeBytes)
    throw std::runtime_error("truncated: " + std::to_string(header.nodes) + " nodes need " +
                             std::to_string(header.nodes * kNodeBytes) + " bytes, " + std::to_string(found) +
                             " found");
  return header;
}

std::string leaf_label_text(const std::vector<LeafLabel>& leaf_labels) {
  std::string text = "key_x,key_y,key_z,depth,label,confidence,label_2,confidence_2,label_3,confidence_3\n";
  char buffer[16];
  const auto append = [&](std::uint32_t value, char end) {
    text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
    text.push_back(end);
  };
  const auto append_share = [&](float value, char end) {
    const int thousandths = static_cast<int>(std::lround(value * 1000));
    text.push_back(static_cast<char>('0' + thousandths / 1000));
    text.push_back('.');
    for (const int place : {100, 10, 1}) text.push_back(static_cast<char>('0' + thousandths / place % 10));
    text.push_back(end);
  };
  for (const LeafLabel& leaf : leaf_labels) {
    for (const std::uint16_t key : leaf.key) append(key, ',');
    append(leaf.depth, ',');
    append(leaf.label, ',');
    append_share(leaf.confidence, ',');
    for (const OtherLabel& other : leaf.others) {
      append(other.label, ',');
      append_share(other.confidence, &other == &leaf.others.back() ? '\n' : ',');
    }
  }
  return text;
}

}  // namespace

void write_octree(const std::filesystem::path& folder, octomap::ColorOcTree& tree,
                  const std::vector<LeafLabel>& leaf_labels, const LabelTable& labels) {
  std::filesystem::create_directories(folder);
  write_tree(folder / "map.ot", kTreeLine, tree, [&](std::ostream& stream) { tree.writeData(stream); });
  write_bytes(folder / "leaf_labels.csv", {leaf_label_text(leaf_labels)});
  std::set<std::uint32_t> present;
  for (const LeafLabel& leaf : leaf_labels) {
    present.insert(leaf.label);
    for (const OtherLabel& other : leaf.others)
      if (other.confidence > 0) present.insert(other.label);
  }
  write_label_csv(folder / "labels.csv", labels, present);
  // Last, as it rounds the tree to occupied and free and prunes it.
  tree.toMaxLikelihood();
  tree.prune();
  write_tree(folder / "map.bt", "# Octomap OcTree binary file", tree, [&](std::ostream& stream) {
    if (tree.getRoot() != nullptr) tree.writeBinaryNode(stream, tree.getRoot());
  });
}

std::unique_ptr<octomap::ColorOcTree> read_octree(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "map.ot";
  const std::string content = read_bytes(file);
  std::istringstream stream(content);
  try {
    const TreeHeader header = read_header(stream, content.size());
    auto tree = std::make_unique<octomap::ColorOcTree>(header.resolution_m);
    if (header.nodes > 0) tree->readData(stream);
    if (!stream || tree->size() != header.nodes) throw std::runtime_error("damaged tree");
    return tree;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::vector<LeafLabel> read_leaf_labels(const std::filesystem::path& folder) {
  std::vector<LeafLabel> leaf_labels;
  read_rows(folder / "leaf_labels.csv", [&](const TextRow& row) {
    if (row.line == 1 && row.columns[0] == "key_x") return;
    if (row.columns.size() != 5 && row.columns.size() != 10)
      throw std::runtime_error("expected 5 or 10 columns, found " + std::to_string(row.columns.size()));
    LeafLabel leaf;
    for (int i = 0; i < 3; ++i)
      leaf.key[i] = static_cast<std::uint16_t>(expect_whole(row.columns[i], "a key", 65535));
    leaf.depth = static_cast<std::uint8_t>(expect_whole(row.columns[3], "depth", 16));
    leaf.label = static_cast<std::uint32_t>(expect_whole(row.columns[4], "label", UINT32_MAX));
    if (row.columns.size() == 10) {
      leaf.confidence = static_cast<float>(expect_number(row.columns[5], "a confidence"));
      for (std::size_t i = 0; i < leaf.others.size(); ++i)
        leaf.others[i] = {
            static_cast<std::uint32_t>(expect_whole(row.columns[6 + 2 * i], "label", UINT32_MAX)),
            static_cast<float>(expect_number(row.columns[7 + 2 * i], "a confidence"))};
    }
    leaf_labels.push_back(leaf);
  });
  return leaf_labels;
}

}  // namespace sediment
