#include "stages/interaction-mask/halo.hpp"

#include <opencv2/imgproc.hpp>

#include "pipeline/scene/frame.hpp"

namespace sediment::interaction_mask {
namespace {

cv::Mat square(int radius_px) {
  return cv::Mat::ones(2 * radius_px + 1, 2 * radius_px + 1, CV_8U);
}

/// How far before the background a pixel must be: four times the noise of a structured-light sensor (0.0012
/// z^2), and some for slanted surfaces.
double margin_units(double depth_units, double depth_scale) {
  const double z_m = depth_units / depth_scale;
  return (0.03 + 0.005 * z_m * z_m) * depth_scale;
}

}  // namespace

cv::Mat grow_over_halo(const cv::Mat& dynamic, const cv::Mat& depth, double depth_scale, int halo_px) {
  if (halo_px <= 0) return dynamic;
  cv::Mat value_near, background = depth.clone();
  cv::dilate(dynamic, value_near, square(halo_px));
  background.setTo(0, dynamic != kStatic);
  cv::dilate(background, background, square(2 * halo_px));

  cv::Mat grown = dynamic.clone();
  for (int y = 0; y < grown.rows; ++y)
    for (int x = 0; x < grown.cols; ++x) {
      const auto near = value_near.at<std::uint8_t>(y, x);
      auto& value = grown.at<std::uint8_t>(y, x);
      if (value != kStatic || near == kStatic) continue;
      const int here = depth.at<std::uint16_t>(y, x), behind = background.at<std::uint16_t>(y, x);
      if (here > 0 && here + margin_units(behind, depth_scale) < behind) value = near;
    }
  return grown;
}

}  // namespace sediment::interaction_mask
