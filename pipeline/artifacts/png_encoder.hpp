#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace sediment {

/// The bytes of a PNG file of a CV_8UC1, CV_8UC3 (BGR) or CV_16UC1 image: equal bytes for equal images. Whole
/// pictures are filtered and compressed at once by libdeflate: against OpenCV at its fastest a fifth less
/// time for colours and half of it for depth, which also becomes a quarter smaller.
std::string png_of(const cv::Mat& image);

}  // namespace sediment
