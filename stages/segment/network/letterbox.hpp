#pragma once

#include <opencv2/core.hpp>

namespace sediment::segment {

/// How an image lies in the input of a network: scaled with its aspect kept, centred, the rest grey. As
/// Ultralytics' LetterBox, rounding included.
struct Letterbox {
  cv::Size image;         ///< of the camera
  cv::Size input;         ///< of the network
  cv::Size scaled;        ///< the image in the input
  int left = 0, top = 0;  ///< where it lies
  double scale = 1;       ///< input pixels per image pixel, before rounding of `scaled`
};

Letterbox fit(cv::Size image, cv::Size input);

/// The smallest input of a dynamic network for an image: longer side `longest`, both sides multiples of
/// `stride` (Ultralytics' `rect`).
cv::Size smallest_input(cv::Size image, int longest, int stride);

/// CV_8UC3 BGR image to a float32 tensor [1, 3, height, width]: RGB planes, 0 .. 1, border 114/255. Throws
/// std::invalid_argument if the image has another size than `letterbox.image`.
cv::Mat to_input(const cv::Mat& bgr, const Letterbox& letterbox);

}  // namespace sediment::segment
