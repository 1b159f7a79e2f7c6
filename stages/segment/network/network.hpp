#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "stages/segment/onnx/layout.hpp"

namespace sediment::segment {

/// What a network says about one image.
struct Prediction {
  cv::Mat anchors;     ///< float32; rows: box centre x y, width, height (input pixels), class scores, mask
                       ///< coefficients; one column per anchor
  cv::Mat prototypes;  ///< float32; one row per mask coefficient, mask_size.area() columns
  cv::Size mask_size;
  std::shared_ptr<void> memory;  ///< of the two, if they do not own it
};

/// A network on some engine. The result for an image does not depend on what else runs at the same time.
class Network {
 public:
  Network() = default;
  virtual ~Network() = default;
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// `input` as to_input() makes it, of the size the network was opened for. Safe to call from several
  /// threads; each call computes on its own thread alone. Throws std::runtime_error that names the network's
  /// file.
  virtual Prediction run(const cv::Mat& input) const = 0;
};

/// Whether this program was built with ONNX Runtime, and its version (empty if not).
std::string onnxruntime_version();

/// ONNX Runtime. Throws std::runtime_error that names the file.
std::unique_ptr<Network> open_with_onnxruntime(const onnx::Model& model, const onnx::Layout& layout,
                                               cv::Size input_size);

/// OpenCV's dnn module, which runs the network up to the decoding of boxes; that is done here. Throws
/// std::runtime_error that names the file.
std::unique_ptr<Network> open_with_opencv(const onnx::Model& model, const onnx::Layout& layout,
                                          cv::Size input_size);

}  // namespace sediment::segment
