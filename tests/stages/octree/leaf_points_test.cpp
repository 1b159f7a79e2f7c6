#include "stages/octree/leaf_points.hpp"

#include <octomap/ColorOcTree.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <stdexcept>

using namespace sediment;
using namespace sediment::octree;

TEST_CASE("keys of coordinates are OctoMap's, at cell borders and on both sides of zero too") {
  std::mt19937 random(1);
  for (const double resolution_m : {0.05, 0.02, 0.1, 0.013}) {
    const octomap::ColorOcTree tree(resolution_m);
    const float reach_m = static_cast<float>(32767 * resolution_m);
    std::uniform_real_distribution<float> anywhere(-reach_m, reach_m);
    for (int i = 0; i < 20000; ++i) {
      const float at_border_m = static_cast<float>(static_cast<int>(random() % 2000 - 1000) * resolution_m);
      for (const float x_m : {anywhere(random), at_border_m, std::nextafter(at_border_m, 1e9F)}) {
        INFO(x_m << " m at " << resolution_m);
        REQUIRE(key_of(x_m, resolution_m) == tree.coordToKey(x_m));
      }
    }
  }
}

TEST_CASE("a code holds its keys and orders nodes as the tree does") {
  std::mt19937 random(2);
  for (int i = 0; i < 10000; ++i) {
    const octomap::OcTreeKey key(random() % 65536, random() % 65536, random() % 65536);
    const std::uint64_t code = code_of(key[0], key[1], key[2]);
    const Keys back = keys_of(code);
    REQUIRE((back.x == key[0] && back.y == key[1] && back.z == key[2]));
    for (unsigned level = 0; level < 16; ++level)
      REQUIRE((code >> (3 * level) & 7) == octomap::computeChildIdx(key, static_cast<int>(level)));
  }
}

TEST_CASE("a coordinate outside the tree is refused and the message says how far the tree reaches") {
  CHECK(key_of(-1638.39F, 0.05) == 0);
  CHECK_THROWS_WITH(key_of(1638.4F, 0.05), Catch::Contains("reaches 1638.4"));
  CHECK_THROWS_AS(key_of(-1638.5F, 0.05), std::runtime_error);
  CHECK_THROWS_AS(key_of(1e6F, 0.05), std::runtime_error);
  CHECK_THROWS_AS(key_of(1e30F, 0.05), std::runtime_error);
  const LabelledCloud cloud{{.x = 0}, {.x = 1e6F}};
  CHECK_THROWS_AS(sort_into_leaves(cloud, 0.05), std::runtime_error);
}

TEST_CASE(
    "sorting by code equals a stable sort, for rooms around the origin, far ones, and any number of "
    "threads") {
  std::mt19937 random(3);
  const float center_m = GENERATE(0.0F, 700.0F, -1600.0F);
  const float spread_m = GENERATE(0.0F, 0.3F, 30.0F);
  const std::size_t size = GENERATE(std::size_t{1}, std::size_t{5}, std::size_t{50000});
  std::uniform_real_distribution<float> offset_m(-spread_m, spread_m);
  LabelledCloud cloud(size);
  for (std::size_t i = 0; i < size; ++i)
    cloud[i] = {.x = center_m + offset_m(random),
                .y = offset_m(random),
                .z = offset_m(random) - center_m,
                .label = static_cast<std::uint32_t>(i)};
  std::vector<LeafPoint> expected;
  for (const LabelledPoint& p : cloud)
    expected.push_back(
        {code_of(key_of(p.x, 0.05), key_of(p.y, 0.05), key_of(p.z, 0.05)), p.b, p.g, p.r, p.label});
  std::stable_sort(expected.begin(), expected.end(), [](auto& a, auto& b) { return a.code < b.code; });

  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const SortedPoints sorted = sort_into_leaves(cloud, 0.05);
    REQUIRE(sorted.points.size() == size);
    bool same = true;
    for (std::size_t i = 0; i < size; ++i)
      same = same && sorted.points[i].code == expected[i].code && sorted.points[i].label == expected[i].label;
    CHECK(same);
  }
}

TEST_CASE("points that are not finite are left out and counted") {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  const LabelledCloud cloud{{.x = nan}, {.x = 1}, {.y = infinite}, {.z = -infinite}, {.z = nan}};
  const SortedPoints sorted = sort_into_leaves(cloud, 0.05);
  CHECK(sorted.points.size() == 1);
  CHECK(sorted.not_finite == 4);
  CHECK(sort_into_leaves({}, 0.05).points.empty());
}
