#pragma once

#include <opencv2/core.hpp>

#include "stages/track/track.hpp"

namespace sediment::track {

/// A keyframe's image (CV_8UC3) with its features: green those that landmarks hold, grey the others; what
/// moves by itself is red, what is moved orange, as everywhere.
cv::Mat features_picture(const cv::Mat& color, const cv::Mat& dynamic, const KeyframeFeatures& keyframe);

/// Histograms of the reprojection errors [px] and of the errors of inverse depth [standard deviations], side
/// by side; over the latter the normal distribution that they should have.
cv::Mat residuals_picture(const Diagnosis& diagnosis);

}  // namespace sediment::track
