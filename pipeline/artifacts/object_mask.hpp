#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/scene/frame.hpp"

namespace sediment {

/// The pixels of one object.
struct ObjectMask {
  std::string class_name;
  double score = 1;
  std::array<double, 4> box_px{};  ///< left top right bottom, in the image
  cv::Rect window;                 ///< of `pixels`, in the image
  cv::Mat pixels;                  ///< CV_8UC1, 255 = object
};

/// The object made of the pixels of an image (CV_8UC1, not 0) with the tight box around them; nothing if
/// there are none.
std::optional<ObjectMask> object_of(std::string class_name, double score, const cv::Mat& pixels);

/// One image of instance ids. Where objects overlap, the one with the higher score has the pixel (equal
/// scores: the earlier one). Ids count from 1 in order of the scores; objects that are covered whole are left
/// out.
InstanceMask paint(std::vector<ObjectMask> objects, cv::Size image);

}  // namespace sediment
