#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sediment {

/// Lengths of runs of pixels, column by column from the top left: background, object, background, ... (COCO's
/// run-length encoding, https://github.com/cocodataset/cocoapi). The first may be 0.
using RunLengths = std::vector<std::uint32_t>;

/// COCO's text form. Throws std::runtime_error: a character that cannot occur, cut off, a negative length.
RunLengths parse_run_lengths(std::string_view text);
std::string format_run_lengths(std::span<const std::uint32_t> lengths);

/// CV_8UC1, 255 = object. Throws std::runtime_error if the lengths do not add up to the size.
cv::Mat mask_from(std::span<const std::uint32_t> lengths, cv::Size size);
/// Of a CV_8UC1 image, object = not 0.
RunLengths run_lengths_of(const cv::Mat& mask);

/// Sets the pixels of `mask` (CV_8UC1) to 255 whose centres lie inside a polygon x0 y0 x1 y1 ... (even-odd
/// rule; the image spans 0 .. width, 0 .. height, as in COCO). Throws std::runtime_error if it has under 3
/// corners, an odd number of values or one that is not finite.
void fill_polygon(std::span<const double> corners, cv::Mat& mask);

}  // namespace sediment
