#include "stages/sor/outlier_filter.hpp"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/stages/sor/test_clouds.hpp"

using namespace sediment;
using sor::Parameters;
using sor::Rule;

namespace {

/// Indices of the points that PCL keeps. test_clouds gives each point its index as instance id.
std::vector<std::uint32_t> kept_by_pcl(const LabelledCloud& cloud, const Parameters& parameters) {
  const auto input = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const LabelledPoint& p : cloud) input->push_back({p.x, p.y, p.z});
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(input);
  filter.setMeanK(parameters.neighbors);
  filter.setStddevMulThresh(parameters.sigmas);
  pcl::Indices kept;
  filter.filter(kept);
  return {kept.begin(), kept.end()};
}

std::vector<std::uint32_t> kept_by_us(LabelledCloud cloud, const Parameters& parameters) {
  sor::remove_outliers(cloud, parameters);
  std::vector<std::uint32_t> kept;
  for (const LabelledPoint& p : cloud) kept.push_back(p.instance);
  return kept;
}

/// A flat 1 cm lattice of side * side points.
LabelledCloud lattice_plane(int side) {
  LabelledCloud cloud;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      LabelledPoint p;
      p.x = 0.01f * static_cast<float>(x);
      p.y = 0.01f * static_cast<float>(y);
      cloud.push_back(p);
    }
  return cloud;
}

}  // namespace

TEST_CASE("one-sided sor keeps point for point what PCL keeps") {
  const std::uint32_t seed = GENERATE(1u, 2u);
  for (const auto& [name, cloud] : test::awkward_clouds(8000, seed))
    for (const int k : {1, 8, 50})
      for (const double sigmas : {0.5, 1.0, 2.5}) {
        INFO(name << ", seed " << seed << ", k = " << k << ", sigmas = " << sigmas);
        const Parameters parameters{k, sigmas, Rule::one_sided};
        const auto expected = kept_by_pcl(cloud, parameters), kept = kept_by_us(cloud, parameters);
        CHECK(kept.size() == expected.size());
        CHECK(kept == expected);
      }
}

TEST_CASE("sor drops one point that floats a metre above a plane") {
  LabelledCloud cloud = lattice_plane(60);
  LabelledPoint floating;
  floating.x = floating.y = 0.3f;
  floating.z = 1;
  floating.label = 62;
  cloud.insert(cloud.begin() + 1234, floating);
  const sor::Statistics statistics = sor::remove_outliers(cloud, Parameters{});
  CHECK(statistics.points == 3601);
  CHECK(std::none_of(cloud.begin(), cloud.end(), [](const LabelledPoint& p) { return p.label == 62; }));
  CHECK(statistics.too_far >= 1);
  CHECK(cloud.size() + statistics.too_far + statistics.too_near == 3601);
}

TEST_CASE("the two-sided rule of the paper also removes points that lie unusually dense") {
  LabelledCloud cloud = lattice_plane(100);
  for (int i = 0; i < 60; ++i) cloud.push_back({0.5f, 0.5f, 1e-5f * static_cast<float>(i), 0, 0, 0, 0, 7, 0});
  const auto dense = [](const LabelledPoint& p) { return p.label == 7; };
  LabelledCloud one_sided = cloud, two_sided = cloud;
  sor::remove_outliers(one_sided, {20, 2.5, Rule::one_sided});
  const auto statistics = sor::remove_outliers(two_sided, {20, 2.5, Rule::two_sided});
  CHECK(std::count_if(one_sided.begin(), one_sided.end(), dense) == 60);
  CHECK(std::count_if(two_sided.begin(), two_sided.end(), dense) == 0);
  CHECK(statistics.too_near >= 60);
  CHECK(statistics.lower_m > 0);
}

TEST_CASE("the statistics are mu and sigma of equation (10)") {
  // Distances of the points to their one neighbour: 1, 1, 2, 4.
  LabelledCloud cloud(4);
  cloud[1].x = 1, cloud[2].x = 3, cloud[3].x = 7;
  const sor::Statistics statistics = sor::remove_outliers(cloud, {1, 1.0, Rule::one_sided});
  CHECK(statistics.mean_m == Approx(2));
  CHECK(statistics.deviation_m == Approx(std::sqrt(2.0)));
  CHECK(statistics.upper_m == Approx(2 + std::sqrt(2.0)));
  CHECK(cloud.size() == 3);
}

TEST_CASE("points that are not finite are dropped and counted and change nothing for the others") {
  LabelledCloud clean = test::noisy_room(5000, 3), dirty = clean;
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, inf, -inf, 3e38f}) {
    LabelledPoint p;
    p.y = bad;
    dirty.insert(dirty.begin() + 100, p);
  }
  const auto clean_statistics = sor::remove_outliers(clean, Parameters{});
  const auto statistics = sor::remove_outliers(dirty, Parameters{});
  CHECK(statistics.not_finite == 4);
  CHECK(statistics.upper_m == clean_statistics.upper_m);
  CHECK(dirty == clean);
}

TEST_CASE("a cloud without spread stays whole") {
  for (const std::size_t size : {0u, 1u, 2u, 1000u}) {
    LabelledCloud cloud(size, LabelledPoint{1, 2, 3, 0, 0, 0, 0, 5, 6});
    const auto statistics = sor::remove_outliers(cloud, Parameters{});
    CHECK(cloud.size() == size);
    CHECK(statistics.deviation_m == 0);
  }
}
