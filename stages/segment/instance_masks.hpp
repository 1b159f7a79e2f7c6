#pragma once

#include <string>
#include <vector>

#include "pipeline/artifacts/object_mask.hpp"
#include "stages/segment/detections.hpp"
#include "stages/segment/network/letterbox.hpp"

namespace sediment::segment {

/// The masks of detections in the image: sigmoid(coefficients x prototypes), interpolated bilinearly to the
/// pixels of the image, more than 0.5, inside the box. Only the prototypes under a box are used. Boxes are
/// clipped to the image; detections without a pixel are left out.
std::vector<ObjectMask> assemble(const Prediction& prediction, const std::vector<Detection>& detections,
                                 const Letterbox& letterbox, const std::vector<std::string>& class_names);

}  // namespace sediment::segment
