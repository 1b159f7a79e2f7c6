#include <octomap/ColorOcTree.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/octree.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
namespace fs = std::filesystem;

namespace {

void write_points(const fs::path& folder, const LabelledCloud& cloud) {
  fs::create_directories(folder);
  write_cloud(folder, cloud, default_labels(), PcdEncoding::binary);
}

test::Outcome run(const test::TemporaryFolder& folder, const std::string& more) {
  return test::run_program("octree", "--cloud '" + (folder / "in").string() + "' " + more);
}

std::string out(const test::TemporaryFolder& folder, const std::string& name) {
  return "--out '" + (folder / name).string() + "' ";
}

}  // namespace

TEST_CASE("OctoMap reads both files of the stage octree, and the .bt is what OctoMap itself writes") {
  const test::TemporaryFolder folder;
  LabelledCloud cloud;
  octomap::ColorOcTree reference(0.1);
  for (int i = 0; i < 5000; ++i) {
    const float x_m = static_cast<float>(i % 71) * 0.05F, y_m = static_cast<float>(i % 53) * -0.05F;
    cloud.push_back({.x = x_m, .y = y_m, .z = 0.01F * static_cast<float>(i % 11), .r = 200, .label = 56});
    reference.updateNode(octomap::point3d(cloud.back().x, cloud.back().y, cloud.back().z), true);
  }
  write_points(folder / "in", cloud);
  const test::Outcome done = run(folder, "--resolution-m 0.1 " + out(folder, "result"));
  INFO(done.output);
  REQUIRE(done.code == 0);

  const auto tree = read_octree(folder / "result");
  CHECK(tree->getResolution() == 0.1);
  CHECK(tree->getNumLeafNodes() == reference.getNumLeafNodes());
  CHECK(tree->search(0.02, -0.02, 0.02)->getColor() == octomap::ColorOcTreeNode::Color(200, 0, 0));
  CHECK(read_leaf_labels(folder / "result").size() == tree->getNumLeafNodes());

  REQUIRE(reference.writeBinary((folder / "reference.bt").string()));
  const auto content = [](const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  // The header's lines name the class, and are the same too.
  CHECK(content(folder / "result/map.bt") == content(folder / "reference.bt"));
}

TEST_CASE("the stage octree writes equal bytes with 1 and with 4 threads") {
  const test::TemporaryFolder folder;
  LabelledCloud cloud;
  for (unsigned i = 0; i < 30000; ++i)
    cloud.push_back({.x = static_cast<float>(i * 7919 % 1000) / 100,
                     .y = static_cast<float>(i * 104729 % 777) / 100,
                     .z = static_cast<float>(i % 300) / 100,
                     .b = static_cast<std::uint8_t>(i),
                     .label = i % 5});
  write_points(folder / "in", cloud);
  REQUIRE(run(folder, "--threads 1 " + out(folder, "one")).code == 0);
  REQUIRE(run(folder, "--threads 4 " + out(folder, "four")).code == 0);
  CHECK(contract::read_manifest(folder / "one").id() == contract::read_manifest(folder / "four").id());
}

TEST_CASE("the stage octree fails with a clear word on no points, points outside the tree and a leaf of 0") {
  const test::TemporaryFolder folder;
  write_points(folder / "in", {});
  const test::Outcome empty = run(folder, out(folder, "result"));
  CHECK(empty.code == 1);
  CHECK_THAT(empty.output, Catch::Contains("no finite point among 0"));
  CHECK(run(folder, "--resolution-m 0 " + out(folder, "result")).code == 2);

  write_points(folder / "in", {{.x = 1e6F}});
  const test::Outcome outside = run(folder, out(folder, "result"));
  CHECK(outside.code == 1);
  CHECK_THAT(outside.output, Catch::Contains("lies outside the tree"));
}
