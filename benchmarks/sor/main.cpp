// Outlier removal on 1 and 2 threads against pcl::StatisticalOutlierRemoval (which has one) in the same run,
// one-sided so that both must keep the same points. Printed as Markdown.
//   benchmark-sor [POINTS[xK][b]...] [CLOUD_FOLDER...]      default: 1000000x50 1000000x20
// POINTS make one room, which gets denser: from some 10 million points on its walls, 5 mm of noise, are
// thicker than the neighbourhoods are wide. With b they make a building of rooms of a million points each,
// which gets larger. From 20 million points on without PCL.
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "benchmarks/timing.hpp"
#include "pipeline/artifacts/cloud.hpp"
#include "stages/sor/outlier_filter.hpp"
#include "tests/stages/sor/test_clouds.hpp"

using namespace sediment;
using benchmark::seconds_of;

namespace {

constexpr std::size_t kTooManyForPcl = 20'000'000;

double peak_gb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1e6;
}

struct PclRun {
  double seconds = 0;
  std::size_t kept = 0;
};

PclRun run_pcl(const LabelledCloud& cloud, int k) {
  const auto input = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const LabelledPoint& p : cloud) input->push_back({p.x, p.y, p.z});
  pcl::Indices kept;
  PclRun run;
  run.seconds = seconds_of([&] {
    pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
    filter.setInputCloud(input);
    filter.setMeanK(k);
    filter.setStddevMulThresh(2.5);
    filter.filter(kept);
  });
  run.kept = kept.size();
  return run;
}

constexpr std::size_t kRoomPoints = 1'000'000;

/// Rooms side by side, ten a row.
LabelledCloud building(std::size_t points) {
  LabelledCloud cloud;
  for (std::size_t room = 0; cloud.size() < points; ++room) {
    const std::size_t size = std::min(kRoomPoints, points - cloud.size());
    const std::size_t row = room / 10, column = room % 10;
    for (LabelledPoint p : test::noisy_room(size, static_cast<std::uint32_t>(room + 1))) {
      p.x += 7.0f * static_cast<float>(column), p.y += 6.0f * static_cast<float>(row);
      cloud.push_back(p);
    }
  }
  return cloud;
}

void compare(const std::string& name, const LabelledCloud& cloud, int k) {
  std::size_t kept = 0;
  double ours_s[2];
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    LabelledCloud filtered = cloud;
    ours_s[threads - 1] = seconds_of([&] { sor::remove_outliers(filtered, {k, 2.5, sor::Rule::one_sided}); });
    kept = filtered.size();
  }
  std::printf("| %s | %zu | %d | %.2f | %.2f | ", name.c_str(), cloud.size(), k, ours_s[0], ours_s[1]);
  if (cloud.size() >= kTooManyForPcl) {
    std::printf("| | | %.1f |\n", peak_gb());
  } else {
    const PclRun pcl = run_pcl(cloud, k);
    std::printf("%.2f | %.1f | %.1f | %s, %.1f |\n", pcl.seconds, pcl.seconds / ours_s[0],
                pcl.seconds / ours_s[1], pcl.kept == kept ? "same" : "OTHERS", peak_gb());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> jobs(argv + 1, argv + argc);
  if (jobs.empty()) jobs = {"1000000x50", "1000000x20"};
  std::printf(
      "| cloud | points | k | 1 thread [s] | 2 threads [s] | PCL [s] | ratio 1 | ratio 2 | kept, peak [GB] "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& job : jobs) {
    if (std::filesystem::exists(job)) {
      compare(job, read_cloud(job), 50);
      continue;
    }
    const std::size_t x = job.find('x');
    const int k = x == std::string::npos ? 50 : std::stoi(job.substr(x + 1));
    if (job.ends_with('b'))
      compare("building", building(std::stoul(job)), k);
    else
      compare("noisy room", test::noisy_room(std::stoul(job), 1), k);
  }
}
