#include "stages/voxel/voxel_filter.hpp"

#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <random>

using namespace sediment;

namespace {

LabelledCloud random_cloud(std::size_t size, float extent, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> along(-extent, extent);
  LabelledCloud cloud(size);
  for (LabelledPoint& p : cloud) {
    p.x = along(random), p.y = along(random), p.z = along(random) / 4;
    p.r = static_cast<std::uint8_t>(random());
    p.g = static_cast<std::uint8_t>(random());
    p.b = static_cast<std::uint8_t>(random());
    p.label = random() % 5;
    p.instance = random() % 3;
  }
  return cloud;
}

LabelledCloud filtered(const LabelledCloud& cloud, double leaf_m, int min_points = 1) {
  voxel::Statistics statistics;
  return voxel::filter(cloud, {leaf_m, min_points}, statistics);
}

pcl::PointCloud<pcl::PointXYZRGB> filtered_by_pcl(const LabelledCloud& cloud, float leaf_m) {
  const auto input = std::make_shared<pcl::PointCloud<pcl::PointXYZRGB>>();
  for (const LabelledPoint& p : cloud) input->push_back({p.x, p.y, p.z, p.r, p.g, p.b});
  pcl::VoxelGrid<pcl::PointXYZRGB> filter;
  filter.setInputCloud(input);
  filter.setLeafSize(leaf_m, leaf_m, leaf_m);
  pcl::PointCloud<pcl::PointXYZRGB> output;
  filter.filter(output);
  return output;
}

/// A point of one voxel with a label, for the votes.
LabelledPoint labelled(std::uint32_t label, std::uint32_t instance) {
  LabelledPoint p;
  p.label = label;
  p.instance = instance;
  return p;
}

}  // namespace

TEST_CASE("voxel centroids and mean colours are those of PCL's VoxelGrid, in the same order") {
  const float leaf_m = GENERATE(0.007f, 0.05f, 0.3f, 100.0f);
  const LabelledCloud cloud = random_cloud(40000, 2, 7);
  const LabelledCloud ours = filtered(cloud, leaf_m);
  const auto theirs = filtered_by_pcl(cloud, leaf_m);
  REQUIRE(ours.size() == theirs.size());
  double worst_m = 0;
  int worst_color = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    worst_m = std::max({worst_m, std::abs(static_cast<double>(ours[i].x) - theirs[i].x),
                        std::abs(static_cast<double>(ours[i].y) - theirs[i].y),
                        std::abs(static_cast<double>(ours[i].z) - theirs[i].z)});
    worst_color = std::max({worst_color, std::abs(ours[i].r - theirs[i].r), std::abs(ours[i].g - theirs[i].g),
                            std::abs(ours[i].b - theirs[i].b)});
  }
  // PCL sums in float: n points of 2 m lose up to n * 2 m * 2^-24.
  CHECK(worst_m < (leaf_m > 1 ? 5e-4 : 1e-6));
  CHECK(worst_color <= 1);  // PCL cuts the fraction off, we round
}

TEST_CASE("a voxel is the mean of its points: position, and colour to the nearest") {
  LabelledCloud cloud(3, LabelledPoint{});
  cloud[0].x = 0.01f, cloud[1].x = 0.02f, cloud[2].x = 0.06f;
  cloud[0].r = 10, cloud[1].r = 11, cloud[2].r = 11;  // mean 10.67
  cloud[0].g = 0, cloud[1].g = 0, cloud[2].g = 1;     // mean 0.33
  const LabelledCloud merged = filtered(cloud, 0.1);
  REQUIRE(merged.size() == 1);
  CHECK(merged[0].x == Approx(0.03f));
  CHECK(static_cast<int>(merged[0].r) == 11);
  CHECK(static_cast<int>(merged[0].g) == 0);
}

TEST_CASE("the label is the majority's, of equally many the smallest") {
  CHECK(filtered({labelled(56, 0), labelled(62, 0), labelled(62, 0)}, 1)[0].label == 62);
  CHECK(filtered({labelled(62, 0), labelled(56, 0), labelled(62, 0), labelled(56, 0)}, 1)[0].label == 56);
  CHECK(filtered({labelled(kUnlabelled, 0), labelled(kUnlabelled, 0), labelled(1, 0)}, 1)[0].label ==
        kUnlabelled);
}

TEST_CASE("the instance is the most frequent one among the points of the winning label") {
  // Instance 9 is the most frequent of all, but on points that lost the vote.
  const LabelledCloud cloud{labelled(1, 9), labelled(1, 9), labelled(1, 9), labelled(2, 5),
                            labelled(2, 4), labelled(2, 5), labelled(2, 3)};
  CHECK(filtered(cloud, 1)[0].label == 2);
  CHECK(filtered(cloud, 1)[0].instance == 5);
  CHECK(filtered({labelled(1, 8), labelled(1, 3)}, 1)[0].instance == 3);
}

TEST_CASE("votes among many labels are counted right") {
  std::mt19937 random(4);
  LabelledCloud cloud;
  std::map<std::uint32_t, int> counts;
  for (int i = 0; i < 500; ++i) {
    cloud.push_back(labelled(random() % 40, i % 2));
    ++counts[cloud.back().label];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](auto& a, auto& b) { return a.second < b.second; });
  CHECK(filtered(cloud, 1)[0].label ==
        most->first);  // the map is in order: the first of equal ones is the smallest
}

TEST_CASE("voxels begin at whole multiples of the leaf, below zero too") {
  LabelledCloud cloud(4, LabelledPoint{});
  cloud[0].x = -0.01f, cloud[1].x = 0.01f, cloud[2].x = 0.99f, cloud[3].x = 1.0f;
  CHECK(filtered(cloud, 1).size() == 3);
}

TEST_CASE("a hall of 200 m x 200 m x 20 m at 5 mm does not overflow") {
  // 6.4e12 voxels: PCL's 32-bit index gives up and returns its input.
  std::mt19937 random(3);
  LabelledCloud cloud;
  for (int i = 0; i < 20000; ++i) {
    LabelledPoint p;
    p.x = static_cast<float>(random() % 40000) * 0.005f + 0.001f;
    p.y = static_cast<float>(random() % 40000) * 0.005f + 0.001f;
    p.z = static_cast<float>(random() % 4000) * 0.005f + 0.001f;
    cloud.push_back(p);
    p.x += 0.002f;
    cloud.push_back(p);  // its companion in the same voxel
  }
  CHECK(filtered_by_pcl(cloud, 0.005f).size() == cloud.size());
  const LabelledCloud merged = filtered(cloud, 0.005);
  CHECK(merged.size() == 20000);
}

TEST_CASE("coordinates of a million metres keep their voxels apart") {
  LabelledCloud cloud(3, LabelledPoint{});
  for (auto& p : cloud) p.x = 1e6f, p.y = -1e6f;
  cloud[1].x += 1;
  cloud[2].z = 0.5f;
  CHECK(filtered(cloud, 0.01).size() == 3);
}

TEST_CASE("too many voxels to number are an error that says what to do") {
  LabelledCloud cloud(2, LabelledPoint{});
  cloud[1] = {1e9f, 1e9f, 1e9f, 0, 0, 0, 0, 0, 0};
  CHECK_THROWS_WITH(filtered(cloud, 0.001), Catch::Contains("raise `leaf`"));
  cloud[1].x = 1e30f;
  CHECK_THROWS_WITH(filtered(cloud, 0.001), Catch::Contains("too large for its leaf size"));
}

TEST_CASE("points that are not finite are left out and counted") {
  LabelledCloud cloud = random_cloud(1000, 1, 1);
  const LabelledCloud clean = filtered(cloud, 0.1);
  cloud[0].x = std::numeric_limits<float>::quiet_NaN();
  cloud[500].z = std::numeric_limits<float>::infinity();
  voxel::Statistics statistics;
  const LabelledCloud merged = voxel::filter(cloud, {0.1, 1}, statistics);
  CHECK(statistics.points == 1000);
  CHECK(statistics.not_finite == 2);
  cloud.erase(cloud.begin() + 500);
  cloud.erase(cloud.begin());
  CHECK(merged == filtered(cloud, 0.1));
}

TEST_CASE("no point, one point and points at one place") {
  CHECK(filtered({}, 0.01).empty());
  const LabelledPoint p{0.1f, 0.2f, 0.3f, 1, 2, 3, 0, 4, 5};
  CHECK(filtered({p}, 0.01) == LabelledCloud{p});
  CHECK(filtered(LabelledCloud(100000, p), 0.01) == LabelledCloud{p});
}

TEST_CASE("voxels with too few points are dropped when asked for") {
  LabelledCloud cloud(5, LabelledPoint{});
  cloud[4].x = 5;
  voxel::Statistics statistics;
  CHECK(voxel::filter(cloud, {1, 2}, statistics).size() == 1);
  CHECK(statistics.voxels == 2);
  CHECK(statistics.too_sparse == 1);
}

TEST_CASE("the voxel filter does not depend on the number of threads") {
  const LabelledCloud cloud = random_cloud(200000, 1, 5);
  std::vector<LabelledCloud> results;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(filtered(cloud, 0.02));
  }
  CHECK(results[0] == results[1]);
}
