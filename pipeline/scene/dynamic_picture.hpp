#pragma once

#include <opencv2/core.hpp>

#include "pipeline/scene/frame.hpp"

namespace sediment {

/// Tints the pixels of `picture` (CV_8UC3, BGR) whose dynamic mask (CV_8UC1, same size) has that value: prior
/// dynamic red, non-prior dynamic orange.
void tint_dynamic(cv::Mat picture, const cv::Mat& dynamic, DynamicValue value);

}  // namespace sediment
