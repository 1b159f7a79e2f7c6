#pragma once

#include <opencv2/core.hpp>

namespace sediment::interaction_mask {

/// Three pictures side by side (CV_8UC3, BGR), as in figures 3 and 18 of the paper: the depth (near is
/// bright, none is black), the prior dynamic pixels over the colour image (red), and the final dynamic mask
/// over it (non-prior dynamic pixels in orange). All images have the size of `color`.
cv::Mat preview_of(const cv::Mat& color, const cv::Mat& depth, double depth_scale, const cv::Mat& dynamic);

}  // namespace sediment::interaction_mask
