#pragma once

#include <opencv2/core.hpp>
#include <string_view>

namespace sediment {

/// The image in a PNG file's bytes, in about half the time of libpng: CV_8UC1, CV_16UC1, or CV_8UC3 (BGR)
/// from 8 bit RGB. Empty if it is of another kind (palette, alpha, interlaced, transparency, ...) or damaged:
/// libpng reads the former and says what is wrong with the latter.
cv::Mat decoded_png(std::string_view file);

}  // namespace sediment
