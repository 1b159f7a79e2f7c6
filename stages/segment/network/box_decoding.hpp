#pragma once

#include "stages/segment/network/network.hpp"

namespace sediment::segment {

/// The tensors of onnx::Head, float32, one column per anchor. Anchors are ordered by level, fine to coarse
/// (strides 8, 16, 32, with more anchors also 4 or 64), then row by row.
struct RawHead {
  cv::Mat bins;          ///< 4 * n rows: sides left, top, right, bottom, n bins each
  cv::Mat logits;        ///< one row per class
  cv::Mat coefficients;  ///< one row per mask coefficient
};

/// The last nodes of YOLOv8's head (Generalized Focal Loss, Li et al. 2020, equation 6): the distance of a
/// side is the mean of its bins under their softmax, in strides, from the anchor's centre; scores are
/// sigmoids. Returns Prediction::anchors. Throws std::runtime_error if the anchors are not those of an input
/// of this size.
cv::Mat decode(const RawHead& head, cv::Size input_size);

}  // namespace sediment::segment
