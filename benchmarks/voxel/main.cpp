// The voxel filter on 1 and 2 threads against pcl::VoxelGrid (which has one) in the same run: centroids and
// colours; ours also finds the majority label and instance. Best of five. Printed as Markdown.
//   benchmark-voxel [POINTS[xMILLIMETRES]...] [CLOUD_FOLDER...]      default: 1000000x10 1000000x50
//   10000000x10
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

#include "benchmarks/timing.hpp"
#include "pipeline/artifacts/cloud.hpp"
#include "stages/voxel/voxel_filter.hpp"
#include "tests/stages/sor/test_clouds.hpp"

using namespace sediment;

namespace {

template <class Work>
double best_seconds(Work work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, benchmark::seconds_since(start));
  }
  return best;
}

void compare(const std::string& name, const LabelledCloud& cloud, double leaf_m) {
  std::size_t voxels = 0;
  double ours_s[2];
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ours_s[threads - 1] = best_seconds([&] {
      voxel::Statistics statistics;
      voxels = voxel::filter(cloud, {leaf_m, 1}, statistics).size();
    });
  }
  const auto input = std::make_shared<pcl::PointCloud<pcl::PointXYZRGB>>();
  for (const LabelledPoint& p : cloud) input->push_back({p.x, p.y, p.z, p.r, p.g, p.b});
  pcl::PointCloud<pcl::PointXYZRGB> output;
  const double pcl_s = best_seconds([&] {
    pcl::VoxelGrid<pcl::PointXYZRGB> filter;
    filter.setInputCloud(input);
    const auto leaf = static_cast<float>(leaf_m);
    filter.setLeafSize(leaf, leaf, leaf);
    filter.filter(output);
  });
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("| %s | %zu | %g | %zu | %.4f | %.4f | %.4f | %.1f | %.1f | %s, %.1f |\n", name.c_str(),
              cloud.size(), leaf_m, voxels, ours_s[0], ours_s[1], pcl_s, pcl_s / ours_s[0], pcl_s / ours_s[1],
              output.size() == voxels ? "same" : "OTHERS", static_cast<double>(usage.ru_maxrss) / 1e6);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> jobs(argv + 1, argv + argc);
  if (jobs.empty()) jobs = {"1000000x10", "1000000x50", "10000000x10"};
  std::printf(
      "| cloud | points | leaf [m] | voxels | 1 thread [s] | 2 threads [s] | PCL [s] | ratio 1 | ratio 2 | "
      "voxels, peak [GB] |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& job : jobs) {
    if (std::filesystem::exists(job)) {
      compare(job, read_cloud(job), 0.01);
      continue;
    }
    const std::size_t x = job.find('x');
    compare("noisy room", test::noisy_room(std::stoul(job), 1),
            x == std::string::npos ? 0.01 : std::stod(job.substr(x + 1)) / 1000);
  }
}
