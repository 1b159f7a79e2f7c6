#pragma once

#include <opencv2/core.hpp>

namespace sediment::track {

/// Depth in metres at a pixel of a raw depth image (CV_16UC1), the median of the 3 x 3 pixels about it, or 0
/// where it says little: too few measured pixels, or a depth edge, where colour and depth images, a pixel or
/// two apart, tell of different surfaces. An edge is a spread above 1 cm + 6 sigma with
/// sigma = depth_noise * z^2 (Khoshelham and Elberink, Sensors 2012).
double reliable_depth_m(const cv::Mat& depth, int x, int y, double depth_scale, double depth_noise);

}  // namespace sediment::track
