// The octree of a room from points, against OctoMap's own insertion loop with colours, in one run, printed as
// Markdown. Arguments: numbers of points in millions; default 1 and 10.
#include <octomap/ColorOcTree.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <sstream>

#include "benchmarks/timing.hpp"
#include "stages/octree/build_tree.hpp"

using namespace sediment;
using namespace sediment::octree;

namespace {

constexpr double kResolution_m = 0.02;

/// Walls, floor and boxes of a room of 8 x 6 x 3 m with 5 mm of noise, in the order in which a camera that
/// turns would see them: patch by patch.
LabelledCloud noisy_room(std::size_t points) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  std::normal_distribution<float> noise_m(0, 0.005F);
  LabelledCloud cloud;
  cloud.reserve(points);
  while (cloud.size() < points) {
    const int wall = static_cast<int>(random() % 6);
    const float left = unit(random) * 0.8F, low = unit(random) * 0.8F;
    for (int i = 0; i < 2000 && cloud.size() < points; ++i) {
      const float s = left + 0.2F * unit(random), t = low + 0.2F * unit(random), n = noise_m(random);
      LabelledPoint point;
      if (wall < 2) point = {.x = 8 * s - 4, .y = 6 * t - 3, .z = static_cast<float>(wall) * 3 + n};
      if (wall == 2 || wall == 3)
        point = {.x = static_cast<float>(wall * 8 - 20) + n, .y = 6 * s - 3, .z = 3 * t};
      if (wall > 3) point = {.x = 8 * s - 4, .y = static_cast<float>(wall * 6 - 27) + n, .z = 3 * t};
      point.r = static_cast<std::uint8_t>(random());
      point.label = static_cast<std::uint32_t>(wall);
      cloud.push_back(point);
    }
  }
  return cloud;
}

std::string binary(octomap::ColorOcTree& tree) {
  std::stringstream stream;
  tree.writeBinary(stream);
  return stream.str();
}

void measure(std::size_t points) {
  const LabelledCloud cloud = noisy_room(points);
  auto start = std::chrono::steady_clock::now();
  octomap::ColorOcTree reference(kResolution_m);
  for (const LabelledPoint& point : cloud) {
    reference.updateNode(octomap::point3d(point.x, point.y, point.z), true);
    reference.integrateNodeColor(point.x, point.y, point.z, point.r, point.g, point.b);
  }
  const double octomap_s = benchmark::seconds_since(start);
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    start = std::chrono::steady_clock::now();
    const SemanticTree ours = build_tree(sort_into_leaves(cloud, kResolution_m).points, {kResolution_m});
    const double ours_s = benchmark::seconds_since(start);
    octomap::ColorOcTree copy(*ours.tree);
    std::printf("| %.0f M | %d | %.2f | %.2f | %.1f | %zu | %s |\n", static_cast<double>(points) * 1e-6,
                threads, ours_s, octomap_s, octomap_s / ours_s, ours.leaf_labels.size(),
                binary(copy) == binary(reference) ? "equal" : "DIFFERENT");
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::puts(
      "| points | threads | ours [s] | OctoMap [s] | ratio | leaves | .bt |\n|---|---|---|---|---|---|---|");
  if (argc == 1)
    for (const std::size_t millions : {1, 10}) measure(millions * 1000000);
  for (int i = 1; i < argc; ++i) measure(static_cast<std::size_t>(std::atof(argv[i]) * 1e6));
}
