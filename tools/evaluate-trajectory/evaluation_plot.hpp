#pragma once

#include <opencv2/core.hpp>

#include "tools/evaluate-trajectory/evaluation.hpp"

namespace sediment::tools {

/// Truth and aligned estimate seen along the axis in which the truth extends least, and the errors over time.
cv::Mat plot(const Evaluation& evaluation, const Trajectory& truth, const Trajectory& estimate);

}  // namespace sediment::tools
