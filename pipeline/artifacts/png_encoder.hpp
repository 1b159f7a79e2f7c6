#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace sediment {

/// The bytes of a PNG file of a CV_8UC1, CV_8UC3 (BGR) or CV_16UC1 image: equal bytes for equal images. Made
/// for speed: whole pictures are filtered and compressed at once, by libdeflate, about four times as fast as
/// by libpng with zlib at its fastest.
std::string png_of(const cv::Mat& image);

}  // namespace sediment
