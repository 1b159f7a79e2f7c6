#include "pipeline/motion/optical_flow.hpp"

#include <cmath>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <stdexcept>

namespace sediment {
namespace {

constexpr double kFlowColumns = 320;
constexpr int kSmallestSide_px = 16;

/// How OpenCV cuts an image for its threads shows in the flow. Its setNumThreads must not run in two threads
/// at once, and callers compute many flows in parallel.
void keep_opencv_to_one_thread() {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (cv::getNumThreads() != 1) cv::setNumThreads(1);
}

}  // namespace

FlowField::FlowField(cv::Mat displacements, cv::Size full)
    : grid_(std::move(displacements)),
      cells_per_px_x_(static_cast<float>(grid_.cols) / static_cast<float>(full.width)),
      cells_per_px_y_(static_cast<float>(grid_.rows) / static_cast<float>(full.height)),
      last_x_(static_cast<float>(grid_.cols - 1)),
      last_y_(static_cast<float>(grid_.rows - 1)) {}

cv::Mat flow_image(const cv::Mat& color) {
  const int factor = std::max(1, static_cast<int>(std::lround(color.cols / kFlowColumns)));
  cv::Mat grey, reduced;
  cv::cvtColor(color, grey, cv::COLOR_BGR2GRAY);
  cv::resize(grey, reduced, {(grey.cols + factor - 1) / factor, (grey.rows + factor - 1) / factor}, 0, 0,
             cv::INTER_AREA);
  return reduced;
}

FlowField flow_between(const cv::Mat& from, const cv::Mat& to, cv::Size full) {
  if (from.size() != to.size() || std::min(from.cols, from.rows) < kSmallestSide_px)
    throw std::invalid_argument("optical flow needs two images of one size, 16 pixels or more to a side");
  keep_opencv_to_one_thread();
  cv::Mat displacements;
  cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(from, to, displacements);
  const double scale_x = static_cast<double>(full.width) / from.cols,
               scale_y = static_cast<double>(full.height) / from.rows;
  cv::multiply(displacements, cv::Scalar(scale_x, scale_y), displacements);
  return FlowField(displacements, full);
}

}  // namespace sediment
