#pragma once

#include <opencv2/imgproc.hpp>
#include <random>

namespace sediment::test {

/// Smooth random texture, CV_8UC3.
inline cv::Mat texture(cv::Size size, unsigned seed) {
  std::mt19937 random(seed);
  cv::Mat noise(size, CV_8UC3);
  for (auto& pixel : cv::Mat_<cv::Vec3b>(noise))
    pixel = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
             static_cast<std::uint8_t>(random())};
  cv::Mat smooth;
  cv::GaussianBlur(noise, smooth, {}, 2);
  cv::normalize(smooth, smooth, 0, 255, cv::NORM_MINMAX);
  return smooth;
}

}  // namespace sediment::test
