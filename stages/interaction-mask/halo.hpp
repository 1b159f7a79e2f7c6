#pragma once

#include <opencv2/core.hpp>

namespace sediment::interaction_mask {

/// Grows a dynamic mask (CV_8UC1 of DynamicValue) over the seam around what moves, where the depth image
/// mixes foreground and background: static pixels within `halo_px` (a square) of a dynamic one that lie
/// before the background there, the farthest static depth within twice that distance. They get the larger
/// value near them. Pixels without depth stay as they are: they put nothing into a map.
cv::Mat grow_over_halo(const cv::Mat& dynamic, const cv::Mat& depth, double depth_scale, int halo_px);

}  // namespace sediment::interaction_mask
