// Synthetic frames of 640x480 a second, part by part on one thread and whole with one and two, printed as
// Markdown. The goal is 15 frames a second on two cores, files included.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "benchmarks/timing.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "tools/synthesize/color_sensor.hpp"
#include "tools/synthesize/depth_sensor.hpp"
#include "tools/synthesize/sequence_writer.hpp"

using namespace sediment;
using benchmark::seconds_of;
using namespace sediment::synthetic;

namespace {

// Processor time, so that other programs disturb little.
void row(const char* part, int times, const std::function<void(int)>& work) {
  double best = 1e9;
  for (int i = 0; i < times; ++i) {
    const std::clock_t start = std::clock();
    work(i);
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::printf("| %s | %.1f |\n", part, 1e3 * best);
}

// Its default: zlib's level 1, one row filter. RLE is faster than zlib's own strategy on colours, slower on
// depth.
void write_by_opencv(const std::filesystem::path& file, const cv::Mat& image) {
  const int strategy =
      image.depth() == CV_8U ? cv::IMWRITE_PNG_STRATEGY_RLE : cv::IMWRITE_PNG_STRATEGY_DEFAULT;
  cv::imwrite(file.string(), image, {cv::IMWRITE_PNG_STRATEGY, strategy});
}

void parts(const Recording& recording, const std::filesystem::path& folder) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  const Renderer renderer(recording.camera());
  const RecordedFrame f = recording.frame(20);
  const cv::Mat loss(480, 640, CV_32FC1, cv::Scalar(0));
  std::printf("| part, one thread, best of 5 | ms of processor time |\n|---|---|\n");
  row("light, and the textures of a frame (once)", 2,
      [](int) { Recording({.scene = "walking", .frames = 1}).frame(0); });
  row("casting and painting", 5,
      [&](int) { renderer.render(recording.scene(), recording.lighting(), f.moment, f.world_from_camera); });
  row("depth sensor", 5, [&](int i) {
    measure_depth(f.exact.depth_m, loss, recording.camera(), {}, static_cast<std::uint64_t>(i));
  });
  row("colour sensor", 5, [&](int i) {
    cv::Mat color = f.exact.color.clone();
    expose(color, 0, 1, static_cast<std::uint64_t>(i));
  });
  row("whole frame without files", 5, [&](int i) { recording.frame(static_cast<std::size_t>(i)); });
  row("colour PNG", 5, [&](int) { write_png(folder / "color.png", f.frame.color); });
  row("the same by OpenCV at its fastest", 5,
      [&](int) { write_by_opencv(folder / "color.png", f.frame.color); });
  row("depth PNG", 5, [&](int) { write_png(folder / "depth.png", f.frame.depth); });
  row("the same by OpenCV at its fastest", 5,
      [&](int) { write_by_opencv(folder / "depth.png", f.frame.depth); });
  row("mask PNGs", 5, [&](int) {
    write_png(folder / "ids.png", f.instances.ids);
    write_png(folder / "dynamic.png", f.dynamic);
  });
}

}  // namespace

int main() {
  std::string name = (std::filesystem::temp_directory_path() / "benchmark-synthesize-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) return 1;
  const std::filesystem::path folder = name;
  constexpr int kFrames = 90;
  const Recording recording({.scene = "walking", .frames = kFrames});
  parts(recording, folder);
  std::printf("\n| threads | frames of 640x480 a second, all files written |\n|---|---|\n");
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const double seconds = seconds_of([&] { write_recording(recording, folder / std::to_string(threads)); });
    std::printf("| %zu | %.1f |\n", threads, kFrames / seconds);
  }
  std::filesystem::remove_all(folder);
}
