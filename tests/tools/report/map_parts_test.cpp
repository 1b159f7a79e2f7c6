#include <octomap/ColorOcTree.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/grid_map.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/octree.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/report/parts.hpp"
#include "tools/report/points_block.hpp"

using namespace sediment;
using namespace sediment::report;

namespace {

unsigned byte_at(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes.at(i));
}

LabelledCloud some_cloud(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> metres(-4, 4);
  LabelledCloud cloud(count);
  for (std::size_t i = 0; i < count; ++i) {
    cloud[i].x = metres(random), cloud[i].y = metres(random), cloud[i].z = metres(random);
    cloud[i].r = static_cast<std::uint8_t>(i % 251);
    cloud[i].label = i % 3 == 0 ? 56 : kUnlabelled;
  }
  return cloud;
}

}  // namespace

TEST_CASE("packed points are where they were to half a step, with their colours and labels") {
  std::vector<ShownPoint> points;
  for (const LabelledPoint& p : some_cloud(500)) points.push_back({{p.x, p.y, p.z}, p.r, p.g, p.b, p.label});
  const PointsBlock block = pack(points, default_labels());
  REQUIRE(block.bytes.size() == 10 * points.size());
  CHECK(block.facts["labels"][0]["name"] == "unlabelled");
  CHECK(block.facts["labels"][1]["name"] == "chair");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double at[] = {points[i].position.x, points[i].position.y, points[i].position.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = block.facts["step"][k], origin = block.facts["origin"][k];
      const unsigned steps = byte_at(block.bytes, 6 * i + 2 * k) | byte_at(block.bytes, 6 * i + 2 * k + 1)
                                                                       << 8;
      CHECK(std::abs(origin + step * steps - at[k]) <= 0.5 * step + 1e-9);
    }
    CHECK(byte_at(block.bytes, 6 * points.size() + 3 * i) == points[i].r);
    CHECK(byte_at(block.bytes, 9 * points.size() + i) == (points[i].label == 56 ? 1u : 0u));
  }
}

TEST_CASE("a cloud with more points than the limit is thinned to just that many, and says of how many") {
  const test::TemporaryFolder folder;
  write_cloud(folder.path(), some_cloud(1000), default_labels(), PcdEncoding::binary);
  Page page;
  const Json thinned = cloud_part(folder.path(), "x3:1", 300, page);
  CHECK(thinned["count"] == 300);
  CHECK(thinned["of"] == 1000);
  CHECK(cloud_part(folder.path(), "x3:1", 2000, page)["count"] == 1000);
}

TEST_CASE("an octree with more leaves than the limit is shown at the finest level that fits") {
  const test::TemporaryFolder folder;
  octomap::ColorOcTree tree(0.05);
  std::vector<LeafLabel> labels;
  for (int x = 0; x < 16; ++x)
    for (int y = 0; y < 16; ++y) {
      const octomap::point3d at(0.05f * static_cast<float>(x) + 0.025f,
                                0.05f * static_cast<float>(y) + 0.025f, 0.025f);
      tree.updateNode(at, true);
      const octomap::OcTreeKey key = tree.coordToKey(at);
      labels.push_back({{key[0], key[1], key[2]}, 16, x < 8 ? 56u : 62u});
    }
  tree.updateInnerOccupancy();
  write_octree(folder.path(), tree, labels, default_labels());
  Page page;
  const Json all = octree_part(folder.path(), "x3:1", 256, page);
  CHECK(all["count"] == 256);
  CHECK(all["level"] == 0);
  const Json coarser = octree_part(folder.path(), "x3:1", 100, page);
  CHECK(coarser["count"] == 64);  // four leaves of the layer in each box
  CHECK(coarser["of"] == 256);
  CHECK(coarser["level"] == 1);
  CHECK(coarser["labels"][0]["count"] == 32);
  CHECK(coarser["labels"][1]["count"] == 32);
}

TEST_CASE("the cells of a grid map are counted by their state") {
  const test::TemporaryFolder folder;
  GridMap map;
  map.width = 4, map.height = 3;
  map.cells.assign(12, Cell::unknown);
  map.at(0, 0) = Cell::occupied;
  map.at(1, 2) = map.at(2, 2) = Cell::free;
  write_grid_map(folder.path(), map);
  Page page;
  const Json part = grid_part(folder.path(), "x3:1", page);
  CHECK(part["occupied"] == 1);
  CHECK(part["free"] == 2);
  CHECK(part["unknown"] == 9);
}
