#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "tools/evaluate-map/nearest_point.hpp"
#include "tools/evaluate-map/voxel_set.hpp"

using namespace sediment;
using namespace sediment::tools;

TEST_CASE("points fall into cells that begin at whole multiples of the side, below zero too") {
  const VoxelSet cells(0.5);
  CHECK(cells.voxel_of({0, 0.49, 0.5}) == Voxel{0, 0, 1});
  CHECK(cells.voxel_of({-0.01, -0.5, -0.51}) == Voxel{-1, -1, -2});
  CHECK(cells.center_of({0, -1, 2}) == Vec3{0.25, -0.25, 1.25});
  CHECK_THROWS(cells.voxel_of({std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  CHECK_THROWS(cells.voxel_of({0, std::numeric_limits<double>::infinity(), 0}));
  CHECK_THROWS(cells.voxel_of({1e9, 0, 0}));
}

TEST_CASE("face neighbours are six, near cells are twenty-six") {
  VoxelSet cells(1);
  cells.insert(Voxel{0, 0, 0});
  CHECK(cells.contains_or_face({0, 0, 1}));
  CHECK_FALSE(cells.contains_or_face({0, 1, 1}));
  CHECK(cells.contains_near({1, 1, -1}));
  CHECK_FALSE(cells.contains_near({0, 0, 2}));
  CHECK(cells.sorted() == std::vector<Voxel>{{0, 0, 0}});
}

TEST_CASE("cells that touch, at a corner too, are one cluster") {
  VoxelSet cells(1);
  for (const Voxel voxel : {Voxel{0, 0, 0}, {1, 1, 1}, {2, 1, 1}, {5, 5, 5}, {7, 5, 5}}) cells.insert(voxel);
  CHECK(cluster_sizes(cells) == std::vector<std::size_t>{3, 1, 1});
  CHECK(cluster_sizes(VoxelSet(1)).empty());
}

TEST_CASE("the nearest point is that of a search through all, ties and clusters included") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  const auto some = [&](std::size_t count, double step) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 p{anywhere(random), anywhere(random), 0.01 * anywhere(random)};
      points.push_back(step == 0 ? p : Vec3{step * std::round(p.x / step), step * std::round(p.y / step), 0});
    }
    return points;
  };
  const std::size_t count = GENERATE(1, 2, 13, 500, 5000);
  const double step = GENERATE(0.0, 0.1);
  const std::vector<Vec3> points = some(count, step), queries = some(300, step);
  const NearestPoint search(points);
  const auto all = search.find_all(queries);
  for (std::size_t q = 0; q < queries.size(); ++q) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (norm(points[i] - queries[q]) < norm(points[best] - queries[q])) best = i;
    const double distance = norm(points[best] - queries[q]);
    REQUIRE(search.find(queries[q]).point_idx == best);
    REQUIRE(all[q].point_idx == best);
    REQUIRE(all[q].distance_m == Approx(distance).margin(1e-15));
    REQUIRE(search.has_within(queries[q], distance + 1e-9));
    if (distance > 0) REQUIRE_FALSE(search.has_within(queries[q], distance * 0.999));
  }
}
