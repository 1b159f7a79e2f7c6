#include "tools/evaluate-masks/overlap.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sediment::tools {
namespace {

/// 255 at the boundary pixels of what is not 0, 0 elsewhere. Pixels at the border of the image are no
/// boundary by themselves.
cv::Mat boundary_of(const cv::Mat& mask) {
  const cv::Mat inside = mask != 0;
  cv::Mat eroded;
  cv::erode(inside, eroded, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}), {-1, -1}, 1,
            cv::BORDER_REPLICATE);
  return inside & ~eroded;
}

/// Share of the pixels of one boundary that are near the other.
double share_near(const cv::Mat& boundary, const cv::Mat& other, const cv::Mat& disc, int pixels) {
  cv::Mat near;
  cv::dilate(other, near, disc);
  return static_cast<double>(cv::countNonZero(boundary & near)) / pixels;
}

}  // namespace

Overlap& Overlap::operator+=(const Overlap& other) {
  hit += other.hit;
  extra += other.extra;
  missed += other.missed;
  none += other.none;
  return *this;
}

Overlap overlap_of(const cv::Mat& truth, const cv::Mat& mask) {
  Overlap counts;
  for (int y = 0; y < truth.rows; ++y) {
    const auto *true_row = truth.ptr<std::uint8_t>(y), *row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < truth.cols; ++x) {
      const bool is_true = true_row[x] != 0, is_masked = row[x] != 0;
      ++(is_true ? (is_masked ? counts.hit : counts.missed) : (is_masked ? counts.extra : counts.none));
    }
  }
  return counts;
}

std::optional<double> boundary_f(const cv::Mat& truth, const cv::Mat& mask, int radius_px) {
  const cv::Mat true_boundary = boundary_of(truth), boundary = boundary_of(mask);
  const int true_pixels = cv::countNonZero(true_boundary), pixels = cv::countNonZero(boundary);
  if (true_pixels == 0 && pixels == 0) return std::nullopt;
  if (true_pixels == 0 || pixels == 0) return 0;
  // A true disc: OpenCV's ellipse leaves out pixels at the radius.
  cv::Mat disc(2 * radius_px + 1, 2 * radius_px + 1, CV_8UC1);
  for (int y = -radius_px; y <= radius_px; ++y)
    for (int x = -radius_px; x <= radius_px; ++x)
      disc.at<std::uint8_t>(y + radius_px, x + radius_px) = x * x + y * y <= radius_px * radius_px;
  const double precision = share_near(boundary, true_boundary, disc, pixels);
  const double recall = share_near(true_boundary, boundary, disc, true_pixels);
  return precision + recall == 0 ? 0 : 2 * precision * recall / (precision + recall);
}

int boundary_radius_px(cv::Size image) {
  return static_cast<int>(std::ceil(0.008 * std::hypot(image.width, image.height)));
}

}  // namespace sediment::tools
