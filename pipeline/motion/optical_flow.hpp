#pragma once

#include <algorithm>
#include <opencv2/core.hpp>

namespace sediment {

/// Where the pixels of one image are in another: displacements in pixels of the full image, kept on a coarser
/// grid.
class FlowField {
 public:
  FlowField() = default;
  /// `displacements` is CV_32FC2, continuous, over an image of `full` pixels.
  FlowField(cv::Mat displacements, cv::Size full);

  bool empty() const { return grid_.empty(); }
  /// Displacement at a position in the full image, bilinear; positions outside have that of the border.
  [[gnu::always_inline]] cv::Point2f at(float u, float v) const {
    const float x = std::min(std::max((u + 0.5F) * cells_per_px_x_ - 0.5F, 0.0F), last_x_);
    const float y = std::min(std::max((v + 0.5F) * cells_per_px_y_ - 0.5F, 0.0F), last_y_);
    const int left = std::min(static_cast<int>(x), grid_.cols - 2),
              top = std::min(static_cast<int>(y), grid_.rows - 2);
    const float right_share = x - static_cast<float>(left), lower_share = y - static_cast<float>(top);
    const auto* upper = grid_.ptr<cv::Point2f>(top) + left;
    const auto* lower = grid_.ptr<cv::Point2f>(top + 1) + left;
    return (1 - lower_share) * ((1 - right_share) * upper[0] + right_share * upper[1]) +
           lower_share * ((1 - right_share) * lower[0] + right_share * lower[1]);
  }

  /// The same at `count` positions.
  void at_each(const float* u, const float* v, std::size_t count, float* du, float* dv) const;

 private:
  cv::Mat grid_;  ///< continuous
  float cells_per_px_x_ = 1, cells_per_px_y_ = 1;
  float last_x_ = 0, last_y_ = 0;
};

/// Whether a displacement holds in both directions: followed by the reverse flow it leads back to where it
/// began, but for 0.01 of the squared lengths and 2 px^2 (Sundaram, Brox, Keutzer 2010, with the constant for
/// a coarser grid). It does not where something is hidden in one of the frames.
inline bool is_mutual(cv::Point2f displacement, cv::Point2f reverse) {
  const cv::Point2f sum = displacement + reverse;
  return sum.dot(sum) <= 0.01F * (displacement.dot(displacement) + reverse.dot(reverse)) + 2;
}

/// The grey image that flow is computed on: reduced by a whole factor to about 320 columns, which costs a
/// quarter of VGA and follows objects as well. `color` is CV_8UC3.
cv::Mat flow_image(const cv::Mat& color);

/// Dense optical flow (Dense Inverse Search, Kroeger et al. 2016, as in OpenCV) between two flow images of
/// frames of size `full`. Deterministic: OpenCV is set to one thread, as its result depends on their number;
/// work on several pairs at a time instead. Throws std::invalid_argument if the sizes differ or a side is
/// below 16 pixels.
FlowField flow_between(const cv::Mat& from, const cv::Mat& to, cv::Size full);

}  // namespace sediment
