// Back-projection of whole VGA frames (every pixel), without reading and writing, printed as Markdown.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <random>

#include "benchmarks/timing.hpp"
#include "stages/fuse/back_projection.hpp"

using namespace sediment;
using namespace sediment::fuse;

namespace {

View noisy_view(unsigned seed) {
  std::mt19937 random(seed);
  View view{cv::Mat(480, 640, CV_8UC3),
            cv::Mat(480, 640, CV_16UC1),
            {cv::Mat(480, 640, CV_16UC1), {{1, "chair"}}},
            cv::Mat(480, 640, CV_8UC1, cv::Scalar(0)),
            pose_from({0.1, 0.2, 0.3, 0.9}, {1, 2, 3})};
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      view.color.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(random()), 1, 2};
      view.depth.at<std::uint16_t>(v, u) =
          static_cast<std::uint16_t>(random() % 10 == 0 ? 0 : 5000 + 20 * v + random() % 100);
      view.mask.ids.at<std::uint16_t>(v, u) = u / 64 % 2;
    }
  view.dynamic(cv::Rect(200, 100, 150, 380)) = kPriorDynamic;
  return view;
}

}  // namespace

int main() {
  const Camera camera{640, 480, 517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}, 5000};
  const std::vector<Ray> rays = rays_of(camera);
  const LabelTable labels({{56, "chair", {255, 0, 0}, false}});
  std::vector<View> views;
  for (unsigned i = 0; i < 8; ++i) views.push_back(noisy_view(i));
  constexpr int kFrames = 400;
  std::puts("| threads | frames of 640x480 a second | million points a second |\n|---|---|---|");
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::atomic<std::size_t> points{0};
    const auto start = std::chrono::steady_clock::now();
    tbb::parallel_for(0, kFrames, [&](int i) {
      LabelledCloud cloud;
      back_project(views[static_cast<std::size_t>(i) % views.size()], camera, rays, labels, {.pixel_step = 1},
                   cloud);
      points += cloud.size();
    });
    const double seconds = benchmark::seconds_since(start);
    std::printf("| %zu | %.0f | %.1f |\n", threads, kFrames / seconds,
                static_cast<double>(points) / seconds * 1e-6);
  }
}
