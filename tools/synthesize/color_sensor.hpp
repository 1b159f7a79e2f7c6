#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace sediment::synthetic {

/// A webcam's picture of an ideal one (CV_8UC3, changed in place): exposure that drifts by a few per cent,
/// the lens's fall-off to the corners, noise of about two grey levels.
void expose(cv::Mat& color, double time_s, std::uint64_t scene_seed, std::uint64_t frame_seed);

}  // namespace sediment::synthetic
