#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sediment::segment::onnx {

/// One operation of the graph. Views lie in Model::bytes.
struct Node {
  std::string_view op_type;
  std::vector<std::string_view> inputs, outputs;  ///< names of tensors
  std::optional<std::int64_t> axis;               ///< the attribute of this name
  std::string_view raw;                           ///< the field of the graph, key included
};

constexpr int kFloat32 = 1;  ///< of TensorProto.DataType

/// An input or output of the graph.
struct Tensor {
  std::string name;
  int element_type = 0;             ///< of TensorProto.DataType: 1 = float32, 10 = float16
  std::vector<std::int64_t> shape;  ///< -1 = dynamic
};

/// "name [1, 3, 480, 640]" with ? for a dynamic size.
std::string to_string(const Tensor& tensor);

/// What Sediment needs to know of an ONNX file: topology and metadata; the weights stay in `bytes`.
struct Model {
  std::filesystem::path file;
  std::string bytes;
  std::vector<Node> nodes;  ///< in topological order, as ONNX demands
  std::vector<Tensor> inputs,
      outputs;  ///< inputs without those that are initializers (old exports list both)
  std::map<std::string, std::string, std::less<>> metadata;

  Model() = default;
  Model(const Model&) = delete;  // the views point into this very object's bytes
  Model& operator=(const Model&) = delete;
  Model(Model&&) = delete;

  /// Reads the file. Throws std::runtime_error that names it: not readable, no ONNX file, truncated.
  explicit Model(const std::filesystem::path& onnx_file);

  /// The node that makes a tensor; nullptr if it is an input or an initializer.
  const Node* producer(std::string_view tensor) const;

 private:
  std::map<std::string_view, std::size_t> producer_;  ///< index of the node, by tensor
};

}  // namespace sediment::segment::onnx
