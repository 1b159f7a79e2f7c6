// Decoding PNG files, ours against OpenCV's (libpng, zlib), one core, file by file in turn; printed as
// Markdown. Arguments: the files
#include <cstdio>
#include <exception>
#include <opencv2/imgcodecs.hpp>

#include "benchmarks/timing.hpp"
#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/png_decoder.hpp"

using namespace sediment;
using benchmark::seconds_of;

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: benchmark-png FILE.png...\n");
    return 2;
  }
  double ours_s = 0, opencv_s = 0;
  int differing = 0;
  for (int i = 1; i < argc; ++i) {
    std::string file = read_bytes(argv[i]);
    cv::Mat ours, opencv;
    ours_s += seconds_of([&] { ours = decoded_png(file); });
    const cv::Mat view(1, static_cast<int>(file.size()), CV_8UC1, file.data());
    opencv_s += seconds_of([&] { opencv = cv::imdecode(view, cv::IMREAD_UNCHANGED); });
    differing += ours.empty() || ours.type() != opencv.type() || ours.size() != opencv.size() ||
                 cv::norm(ours, opencv, cv::NORM_INF) > 0;
  }
  std::printf("| files | ours, ms | OpenCV, ms | times as fast | unlike OpenCV's |\n|---|---|---|---|---|\n");
  const int files = argc - 1;
  const double ms_a_file = 1e3 / files;
  std::printf("| %d | %.2f | %.2f | %.2f | %d |\n", files, ours_s * ms_a_file, opencv_s * ms_a_file,
              opencv_s / ours_s, differing);
} catch (const std::exception& error) {
  std::fprintf(stderr, "benchmark-png: %s\n", error.what());
  return 1;
}
