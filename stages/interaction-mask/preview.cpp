#include "stages/interaction-mask/preview.hpp"

#include <opencv2/imgproc.hpp>

#include "pipeline/scene/dynamic_picture.hpp"

namespace sediment::interaction_mask {
namespace {

constexpr double kFarthestShown_m = 5;

cv::Mat shade(const cv::Mat& depth, double depth_scale) {
  cv::Mat nearness, shaded;
  // 255 at the camera, 40 at the farthest depth shown: still told from black, which is no depth.
  depth.convertTo(nearness, CV_8U, -215.0 / (kFarthestShown_m * depth_scale), 255);
  nearness = cv::max(nearness, 40);
  nearness.setTo(0, depth == 0);
  cv::cvtColor(nearness, shaded, cv::COLOR_GRAY2BGR);
  return shaded;
}

}  // namespace

cv::Mat preview_of(const cv::Mat& color, const cv::Mat& depth, double depth_scale, const cv::Mat& dynamic) {
  cv::Mat prior = color.clone(), preview;
  tint_dynamic(prior, dynamic, kPriorDynamic);
  cv::Mat both = prior.clone();
  tint_dynamic(both, dynamic, kNonPriorDynamic);
  cv::hconcat(std::vector<cv::Mat>{shade(depth, depth_scale), prior, both}, preview);
  return preview;
}

}  // namespace sediment::interaction_mask
