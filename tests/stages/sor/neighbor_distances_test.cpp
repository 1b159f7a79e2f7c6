#include "stages/sor/neighbor_distances.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/stages/sor/test_clouds.hpp"

using namespace sediment;
using sediment::sor::mean_neighbor_distances;
using sediment::sor::Position;

namespace {

std::vector<Position> positions_of(const LabelledCloud& cloud) {
  std::vector<Position> positions;
  for (const LabelledPoint& p : cloud) positions.push_back({p.x, p.y, p.z});
  return positions;
}

/// All pairs.
std::vector<float> brute_force(const std::vector<Position>& points, std::size_t k) {
  std::vector<float> means, squared(points.size());
  k = std::min(k, points.size() - 1);
  for (const Position& p : points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float dx = points[i].x - p.x, dy = points[i].y - p.y, dz = points[i].z - p.z;
      squared[i] = dx * dx + dy * dy + dz * dz;
    }
    std::sort(squared.begin(), squared.end());
    double sum = 0;
    for (std::size_t i = 1; i <= k; ++i) sum += std::sqrt(static_cast<double>(squared[i]));
    means.push_back(k == 0 ? 0 : static_cast<float>(sum / static_cast<double>(k)));
  }
  return means;
}

}  // namespace

TEST_CASE("mean neighbour distances are those of all pairs") {
  const std::size_t k = GENERATE(1u, 2u, 7u, 50u, 333u);
  for (const auto& [name, cloud] : test::awkward_clouds(1500, 4)) {
    INFO(name << ", k = " << k);
    const std::vector<Position> points = positions_of(cloud);
    const std::vector<float> expected = brute_force(points, k), found = mean_neighbor_distances(points, k);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      wrong += std::abs(found[i] - expected[i]) <= 1e-7f * expected[i] ? 0 : 1;
    CHECK(wrong == 0);
  }
}

TEST_CASE("every kernel that this processor can run gives the same bits") {
  for (const auto& [name, cloud] : test::awkward_clouds(5000, 6)) {
    const std::vector<Position> points = positions_of(cloud);
    for (const std::size_t k : {3u, 50u}) {
      const auto plain = mean_neighbor_distances(points, k, *sor::available_kernels().front());
      for (const sor::NearestKernel* kernel : sor::available_kernels()) {
        INFO(name << ", k = " << k << ", " << kernel->name);
        CHECK(mean_neighbor_distances(points, k, *kernel) == plain);
      }
    }
  }
}

TEST_CASE("k beyond the size of the cloud means all the others") {
  const std::vector<Position> points{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  CHECK(mean_neighbor_distances(points, 1000) == std::vector<float>{2, 1.5f, 2.5f});
  CHECK(mean_neighbor_distances(points, 2) == mean_neighbor_distances(points, 1000));
}

TEST_CASE("no point, one point and points at one place have distances of zero") {
  CHECK(mean_neighbor_distances({}, 5).empty());
  CHECK(mean_neighbor_distances(std::vector<Position>{{1, 2, 3}}, 5) == std::vector<float>{0});
  const std::vector<Position> equal(200000, {1, 2, 3});
  CHECK(mean_neighbor_distances(equal, 50) == std::vector<float>(equal.size(), 0));
}

TEST_CASE("mean neighbour distances do not depend on the number of threads") {
  const std::vector<Position> points = positions_of(test::noisy_room(50000, 9));
  std::vector<std::vector<float>> results;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(mean_neighbor_distances(points, 20));
  }
  CHECK(results[0] == results[1]);
}
