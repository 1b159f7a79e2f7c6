// Decoding PNG files, ours against OpenCV's (libpng, zlib), one core, file by file in turn; printed as
// Markdown. Arguments: the files
#include <chrono>
#include <cstdio>
#include <exception>
#include <opencv2/imgcodecs.hpp>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/png_decoder.hpp"

using namespace sediment;

namespace {

template <class Work>
double milliseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: benchmark-png FILE.png...\n");
    return 2;
  }
  double ours_ms = 0, opencv_ms = 0;
  int differing = 0;
  for (int i = 1; i < argc; ++i) {
    std::string file = read_bytes(argv[i]);
    cv::Mat ours, opencv;
    ours_ms += milliseconds([&] { ours = decoded_png(file); });
    const cv::Mat view(1, static_cast<int>(file.size()), CV_8UC1, file.data());
    opencv_ms += milliseconds([&] { opencv = cv::imdecode(view, cv::IMREAD_UNCHANGED); });
    differing += ours.empty() || ours.type() != opencv.type() || ours.size() != opencv.size() ||
                 cv::norm(ours, opencv, cv::NORM_INF) > 0;
  }
  std::printf("| files | ours, ms | OpenCV, ms | times as fast | unlike OpenCV's |\n|---|---|---|---|---|\n");
  const int files = argc - 1;
  std::printf("| %d | %.2f | %.2f | %.2f | %d |\n", files, ours_ms / files, opencv_ms / files,
              opencv_ms / ours_ms, differing);
} catch (const std::exception& error) {
  std::fprintf(stderr, "benchmark-png: %s\n", error.what());
  return 1;
}
