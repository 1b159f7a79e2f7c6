// Stands in for onnxruntime_network.cpp where ONNX Runtime was not found.
#include <stdexcept>

#include "stages/segment/network/network.hpp"

namespace sediment::segment {

std::string onnxruntime_version() {
  return {};
}

std::unique_ptr<Network> open_with_onnxruntime(const onnx::Model&, const onnx::Layout&, cv::Size) {
  throw std::runtime_error(
      "engine onnxruntime: this program was built without ONNX Runtime (scripts/fetch_onnxruntime.sh fetches "
      "it; "
      "then configure and build again)");
}

}  // namespace sediment::segment
