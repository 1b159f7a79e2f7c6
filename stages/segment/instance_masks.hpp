#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/scene/frame.hpp"
#include "stages/segment/detections.hpp"
#include "stages/segment/network/letterbox.hpp"

namespace sediment::segment {

/// The pixels of one object.
struct ObjectMask {
  std::string class_name;
  double score = 1;
  std::array<double, 4> box_px{};  ///< left top right bottom, in the image
  cv::Rect window;                 ///< of `pixels`, in the image
  cv::Mat pixels;                  ///< CV_8UC1, 255 = object
};

/// The masks of detections in the image: sigmoid(coefficients x prototypes), interpolated bilinearly to the
/// pixels of the image, more than 0.5, inside the box. Only the prototypes under a box are used. Boxes are
/// clipped to the image; detections without a pixel are left out.
std::vector<ObjectMask> assemble(const Prediction& prediction, const std::vector<Detection>& detections,
                                 const Letterbox& letterbox, const std::vector<std::string>& class_names);

/// The object made of the pixels of an image (CV_8UC1, not 0) with the tight box around them; nothing if
/// there are none.
std::optional<ObjectMask> object_of(std::string class_name, double score, const cv::Mat& pixels);

/// One image of instance ids. Where objects overlap, the one with the higher score has the pixel (equal
/// scores: the earlier one). Ids count from 1 in order of the scores; objects that are covered whole are left
/// out.
InstanceMask paint(std::vector<ObjectMask> objects, cv::Size image);

}  // namespace sediment::segment
