#pragma once

#include <string>
#include <vector>

#include "stages/segment/onnx/model.hpp"

namespace sediment::segment::onnx {

/// Height and width of an image in pixels.
struct Size {
  int height = 0, width = 0;
  friend bool operator==(const Size&, const Size&) = default;
};

/// What a YOLOv8-seg or YOLO11-seg export says about itself. With c classes and k mask coefficients its
/// outputs are the anchors [1, 4 + c + k, n] (box centre and size in input pixels, class scores,
/// coefficients) and the prototypes [1, k, h, w]; they are told apart by their shapes, never by their order
/// or names.
struct Layout {
  std::string input;                     ///< [1, 3, height, width], float32, RGB, 0 .. 1
  Size input_size;                       ///< 0 where dynamic
  Size trained_size;                     ///< metadata `imgsz`, 640x640 if it is not there
  int stride = 32;                       ///< metadata `stride`: sizes of dynamic inputs are multiples of it
  std::string anchors, prototypes;       ///< names of the outputs
  int mask_coefficients = 0;             ///< k
  std::vector<std::string> class_names;  ///< c names by class index
};

/// `class_names` replaces the names of the metadata if it is not empty. Throws std::runtime_error that names
/// the file and says what was expected and found: no segmentation head, not float32, more than one image at a
/// time, no class names.
Layout read_layout(const Model& model, const std::vector<std::string>& class_names = {});

/// Reads the metadata `names`: a Python dictionary {0: 'person', 1: "..."} or list. Throws std::runtime_error
/// unless it has the keys 0 .. n-1.
std::vector<std::string> parse_class_names(const std::string& python);

}  // namespace sediment::segment::onnx
