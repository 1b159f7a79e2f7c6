#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace sediment::test {

/// A network in the layout of a YOLOv8-seg export, without weights that were learned: it finds blocks of 32 x
/// 32 pixels of pure red (class 0) and pure green (class 1) on black, exactly. In words: the anchor of stride
/// 32 whose cell is red scores 1 / (1 + e^-10) for class 0. Its box reaches from 16 pixels left of and above
/// the centre of the cell to 48 right and 32 below. Its mask logit is +10 on red and green and -10 on black,
/// in prototypes of 4 x 4 pixels.
struct TinyNetwork {
  cv::Size input{96, 64};                                     ///< multiples of 32
  std::string names = "{0: 'red thing', 1: \"it's green\"}";  ///< metadata; empty: none
  bool dynamic = false;    ///< declares height, width and anchors as dynamic, and
                           ///< computes shapes; runs at `input` all the same
  bool attention = false;  ///< YOLO11's block before the logits: changes scores
  bool split = false;      ///< bins and logits in one tensor that is split, as in older exports
  bool swapped = false;    ///< prototypes first
  bool segments = true;    ///< false: a detection network
  int element_type = 1;    ///< of the input: 10 = float16
  int batch = 1;
};

std::string onnx_file(const TinyNetwork& network);
void write_onnx(const std::filesystem::path& file, const TinyNetwork& network);

/// Box of the object whose cell (of 32 x 32 pixels) begins at `corner`, in input pixels, clipped to `image`.
cv::Rect box_at(cv::Point corner, cv::Size image);

}  // namespace sediment::test
