#include "stages/interaction-mask/preview.hpp"

#include <opencv2/imgproc.hpp>

#include "pipeline/scene/frame.hpp"

namespace sediment::interaction_mask {
namespace {

constexpr double kFarthestShown_m = 5;
const cv::Vec3b kPriorBgr(40, 40, 230), kNonPriorBgr(0, 150, 255);

cv::Mat shade(const cv::Mat& depth, double depth_scale) {
  cv::Mat nearness, shaded;
  // 255 at the camera, 40 at the farthest depth shown: still told from black, which is no depth.
  depth.convertTo(nearness, CV_8U, -215.0 / (kFarthestShown_m * depth_scale), 255);
  nearness = cv::max(nearness, 40);
  nearness.setTo(0, depth == 0);
  cv::cvtColor(nearness, shaded, cv::COLOR_GRAY2BGR);
  return shaded;
}

void tint(cv::Mat image, const cv::Mat& where, cv::Vec3b bgr) {
  cv::Mat tinted;
  cv::addWeighted(image, 0.45, cv::Mat(image.size(), CV_8UC3, cv::Scalar(bgr)), 0.55, 0, tinted);
  tinted.copyTo(image, where);
}

}  // namespace

cv::Mat preview_of(const cv::Mat& color, const cv::Mat& depth, double depth_scale, const cv::Mat& dynamic) {
  cv::Mat prior = color.clone(), both = color.clone(), preview;
  tint(prior, dynamic == kPriorDynamic, kPriorBgr);
  tint(both, dynamic == kPriorDynamic, kPriorBgr);
  tint(both, dynamic == kNonPriorDynamic, kNonPriorBgr);
  cv::hconcat(std::vector<cv::Mat>{shade(depth, depth_scale), prior, both}, preview);
  return preview;
}

}  // namespace sediment::interaction_mask
