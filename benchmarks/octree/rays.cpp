// Free space by rays, against OctoMap's insertPointCloud (discretised), in one run, printed as Markdown:
// frames of 640 x 480 of the synthetic walking scene at 2 cm. OctoMap is given the points; ours begins with
// depth images. Arguments: number of frames (default 100), resolution in metres.
#include <octomap/ColorOcTree.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "benchmarks/timing.hpp"
#include "stages/octree/build_tree.hpp"
#include "tests/synthetic/synthetic_sequence.hpp"

using namespace sediment;
using namespace sediment::octree;

namespace {

octomap::point3d origin_of(const Pose& pose) {
  return {static_cast<float>(pose.translation.x), static_cast<float>(pose.translation.y),
          static_cast<float>(pose.translation.z)};
}

octomap::Pointcloud points_of(const std::vector<RayEnd>& ends, const octomap::ColorOcTree& tree) {
  octomap::Pointcloud cloud;
  for (const RayEnd& end : ends)
    if (end.fills) cloud.push_back(tree.keyToCoord({end.keys.x, end.keys.y, end.keys.z}));
  return cloud;
}

RayMap cast_all(const test::SyntheticSequence& sequence, double resolution_m, std::size_t in_flight) {
  RayMap map(octomap::ColorOcTree{resolution_m});
  const std::vector<Ray> rays = rays_of(sequence.camera);
  std::size_t next = 0;
  tbb::parallel_pipeline(
      in_flight,
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                          [&](tbb::flow_control& flow) {
                                            if (next == sequence.frames.size()) flow.stop();
                                            return next++;
                                          }) &
          tbb::make_filter<std::size_t, std::vector<Brick>>(
              tbb::filter_mode::parallel,
              [&](std::size_t i) {
                const Pose& pose = sequence.groundtruth[i].world_from_camera;
                const auto ends =
                    ray_ends({pose, sequence.frames[i].depth, {}}, sequence.camera, rays, {}, resolution_m);
                return cells_of_rays(pose.translation, ends, resolution_m);
              }) &
          tbb::make_filter<std::vector<Brick>, void>(
              tbb::filter_mode::serial_in_order, [&](const std::vector<Brick>& cells) { map.add(cells); }));
  return map;
}

bool is_equal(octomap::ColorOcTree& ours, octomap::ColorOcTree& reference) {
  if (ours.size() != reference.size()) return false;
  auto expected = reference.begin_leafs();
  for (auto leaf = ours.begin_leafs(); leaf != ours.end_leafs(); ++leaf, ++expected)
    if (leaf.getKey() != expected.getKey() || leaf->getLogOdds() != expected->getLogOdds()) return false;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 100;
  const double resolution_m = argc > 2 ? std::atof(argv[2]) : 0.02;
  auto sequence = test::synthetic_sequence({.frames = frames, .width = 640, .height = 480});
  // Pixels beyond the range clear only, which OctoMap cannot be told: both go without.
  for (Frame& frame : sequence.frames)
    frame.depth.setTo(0, frame.depth > RayParameters{}.max_depth_m * sequence.camera.depth_scale);
  const std::vector<Ray> rays = rays_of(sequence.camera);
  octomap::ColorOcTree reference(resolution_m);
  double octomap_s = 0;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const Pose& pose = sequence.groundtruth[i].world_from_camera;
    const octomap::Pointcloud cloud = points_of(
        ray_ends({pose, sequence.frames[i].depth, {}}, sequence.camera, rays, {}, resolution_m), reference);
    const auto start = std::chrono::steady_clock::now();
    reference.insertPointCloud(cloud, origin_of(pose), -1, false, true);
    octomap_s += benchmark::seconds_since(start);
  }
  std::puts(
      "| frames | cell [m] | threads | ours: rays [s] | with the tree [s] | OctoMap [s] | ratio | leaves | "
      "sets and log-odds |\n|---|---|---|---|---|---|---|---|---|");
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto start = std::chrono::steady_clock::now();
    const RayMap map = cast_all(sequence, resolution_m, 2 * static_cast<std::size_t>(threads));
    const double cast_s = benchmark::seconds_since(start);
    SemanticTree ours = build_tree({}, map.cells(), Occupied::by_rays, {.resolution_m = resolution_m});
    const double all_s = benchmark::seconds_since(start);
    std::printf("| %d | %.3f | %d | %.2f | %.2f | %.1f | %.1f | %zu | %s |\n", frames, resolution_m, threads,
                cast_s, all_s, octomap_s, octomap_s / all_s, ours.tree->getNumLeafNodes(),
                is_equal(*ours.tree, reference) ? "equal" : "DIFFERENT");
  }
}
