#include "pipeline/artifacts/octree.hpp"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <catch2/catch.hpp>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

std::unique_ptr<octomap::ColorOcTree> some_tree() {
  auto tree = std::make_unique<octomap::ColorOcTree>(0.05);
  for (int i = 0; i < 40; ++i) {
    const octomap::point3d at(0.05f * static_cast<float>(i) + 0.025f, 0.5f, -1);
    tree->updateNode(at, true);
    tree->setNodeColor(at.x(), at.y(), at.z(), static_cast<std::uint8_t>(i), 100, 7);
  }
  tree->updateNode(octomap::point3d(0, 0, 2), false);
  tree->updateInnerOccupancy();
  return tree;
}

}  // namespace

TEST_CASE("an octree survives writing and reading, and OctoMap opens both files") {
  const test::TemporaryFolder folder;
  const auto tree = some_tree();
  std::vector<LeafLabel> leaf_labels{{{1, 2, 3}, 16, 56}, {{65535, 0, 9}, 15, kUnlabelled}};
  leaf_labels[0].confidence = 0.75F;
  leaf_labels[0].others = {{{57, 0.25F}, {}}};
  write_octree(folder.path(), *some_tree(), leaf_labels, default_labels());

  const auto read = read_octree(folder.path());
  CHECK(*read == *tree);
  const std::unique_ptr<octomap::AbstractOcTree> by_octomap(
      octomap::AbstractOcTree::read((folder / "map.ot").string()));
  const auto* colored = dynamic_cast<octomap::ColorOcTree*>(by_octomap.get());
  REQUIRE(colored != nullptr);
  CHECK(colored->search(0.05 * 7 + 0.025, 0.5, -1)->getColor() == octomap::ColorOcTreeNode::Color(7, 100, 7));

  octomap::OcTree binary((folder / "map.bt").string());
  CHECK(binary.getResolution() == 0.05);
  CHECK(binary.isNodeOccupied(binary.search(0.025, 0.5, -1)));
  CHECK_FALSE(binary.isNodeOccupied(binary.search(0, 0, 2)));

  const auto labels = read_leaf_labels(folder.path());
  REQUIRE(labels.size() == 2);
  CHECK(labels[1].key[0] == 65535);
  CHECK(labels[1].depth == 15);
  CHECK(labels[0].label == 56);
  CHECK(labels[0].confidence == 0.75F);
  CHECK(labels[0].others == leaf_labels[0].others);
  CHECK(read_bytes(folder / "labels.csv").starts_with("id,name,r,g,b\n56,chair,230,25,25\n57,couch,"));
}

TEST_CASE("the files of a tree are the ones that OctoMap writes by itself") {
  const test::TemporaryFolder folder;
  write_octree(folder.path(), *some_tree(), {}, default_labels());
  some_tree()->write((folder / "by_octomap.ot").string());
  some_tree()->writeBinary((folder / "by_octomap.bt").string());
  CHECK(read_bytes(folder / "map.ot") == read_bytes(folder / "by_octomap.ot"));
  CHECK(read_bytes(folder / "map.bt") == read_bytes(folder / "by_octomap.bt"));
}

TEST_CASE("an octree file that is cut off or of another kind is refused by name") {
  const test::TemporaryFolder folder;
  const auto file = folder / "map.ot";
  write_octree(folder.path(), *some_tree(), {}, default_labels());
  const std::string whole = read_bytes(file);
  std::string expected;
  SECTION("cut off in the nodes") {
    write_bytes(file, {whole.substr(0, whole.size() - std::size_t{GENERATE(1u, 100u)})});
    expected = "truncated";
  }
  SECTION("cut off in the header") {
    write_bytes(file, {whole.substr(0, 30)});
    expected = "truncated header";
  }
  SECTION("another tree class") {
    octomap::OcTree(0.1).write(file.string());
    expected = "expected a ColorOcTree, found \"OcTree\"";
  }
  SECTION("no tree") {
    write_bytes(file, {"hello\n"});
    expected = "not an OctoMap tree";
  }
  SECTION("missing") {
    std::filesystem::remove(file);
    expected = "No such file";
  }
  CHECK_THROWS_WITH(read_octree(folder.path()), Contains(file.string()) && Contains(expected));
}

TEST_CASE("damaged leaf labels are refused with their line") {
  const test::TemporaryFolder folder;
  write_bytes(folder / "leaf_labels.csv", {"key_x,key_y,key_z,depth,label\n1,2,3,16,56\n1,2,70000,16,56\n"});
  CHECK_THROWS_WITH(read_leaf_labels(folder.path()), Contains("leaf_labels.csv:3: ") && Contains("70000"));
}

TEST_CASE("leaf labels without confidence are read as certain") {
  const test::TemporaryFolder folder;
  write_bytes(folder / "leaf_labels.csv", {"key_x,key_y,key_z,depth,label\n1,2,3,16,56\n"});
  const auto labels = read_leaf_labels(folder.path());
  REQUIRE(labels.size() == 1);
  CHECK(labels[0].confidence == 1);
  CHECK(labels[0].others[0].confidence == 0);
}

TEST_CASE("an octree on a full disk is an error that names the file") {
  const test::TemporaryFolder folder;
  if (!std::filesystem::exists("/dev/full")) return;
  std::filesystem::create_symlink("/dev/full", folder / "map.ot");
  CHECK_THROWS_WITH(write_octree(folder.path(), *some_tree(), {}, default_labels()), Contains("map.ot"));
}
