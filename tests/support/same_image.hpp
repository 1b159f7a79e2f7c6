#pragma once

#include <opencv2/core.hpp>

namespace sediment::test {

inline bool same_image(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace sediment::test
