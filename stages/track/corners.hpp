#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sediment::track {

/// The levels of the image pyramid, each kPyramidScale smaller than the one before.
std::vector<cv::Mat> image_pyramid(const cv::Mat& gray);

/// About `wanted` oriented FAST corners over all levels, spread evenly over the image; positions in pixels of
/// level 0, octave = level, ordered by level. `allowed` (CV_8UC1, may be empty) is 0 where none may be.
std::vector<cv::KeyPoint> spread_corners(const std::vector<cv::Mat>& pyramid, const cv::Mat& allowed,
                                         int wanted);

}  // namespace sediment::track
