#pragma once

#include <string>

#include "stages/segment/onnx/layout.hpp"

namespace sediment::segment::onnx {

/// The tensors [1, rows, anchors] from which a YOLOv8-seg head computes its outputs: where the last nodes,
/// which OpenCV cannot run, begin. Bins and logits may be one tensor, bins first.
struct Head {
  std::string bins;          ///< distribution of the four box sides, 4 * bins rows, before the softmax
  std::string logits;        ///< of the classes, before the sigmoid
  std::string coefficients;  ///< of the masks, final
};

/// Walks back from the outputs, since YOLOv8, YOLO11 and their exporters name and order nodes differently.
/// Throws std::runtime_error that names the file if the graph does not end in such a head.
Head find_head(const Model& model, const Layout& layout);

/// Names of the nodes at which a network made by cut_before_decoding() ends. Where bins and logits are one
/// tensor it has the first name.
namespace output_name {
inline constexpr const char* kBins = "sediment_bins";
inline constexpr const char* kLogits = "sediment_logits";
inline constexpr const char* kCoefficients = "sediment_coefficients";
inline constexpr const char* kPrototypes = "sediment_prototypes";
}  // namespace output_name

/// The network as an ONNX file in memory that takes one image of `input_size` and ends in the tensors of
/// `head` and the prototypes. Nodes and weights behind them are left out.
std::string cut_before_decoding(const Model& model, const Layout& layout, const Head& head, Size input_size);

}  // namespace sediment::segment::onnx
