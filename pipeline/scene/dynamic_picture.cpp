#include "pipeline/scene/dynamic_picture.hpp"

namespace sediment {
namespace {

const cv::Scalar kPriorBgr(40, 40, 230), kNonPriorBgr(0, 150, 255);

}  // namespace

void tint_dynamic(cv::Mat picture, const cv::Mat& dynamic, DynamicValue value) {
  const cv::Scalar& bgr = value == kPriorDynamic ? kPriorBgr : kNonPriorBgr;
  cv::Mat tinted;
  cv::addWeighted(picture, 0.5, cv::Mat(picture.size(), CV_8UC3, bgr), 0.5, 0, tinted);
  tinted.copyTo(picture, dynamic == value);
}

}  // namespace sediment
