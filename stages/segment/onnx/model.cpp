#include "stages/segment/onnx/model.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"
#include "stages/segment/onnx/model_fields.hpp"
#include "stages/segment/onnx/wire.hpp"

namespace sediment::segment::onnx {
namespace {

std::string_view text_of(std::string_view message, std::uint32_t number) {
  WireReader reader(message);
  std::string_view found;
  for (Field part; reader.next(part);)
    if (part.number == number) found = part.bytes;
  return found;
}

std::optional<std::int64_t> axis_of(std::string_view attribute) {
  if (text_of(attribute, field::kAttributeName) != "axis") return std::nullopt;
  std::int64_t axis = 0;
  WireReader reader(attribute);
  for (Field part; reader.next(part);)
    if (part.number == field::kAttributeInt) axis = static_cast<std::int64_t>(part.number_value);
  return axis;
}

Node read_node(const Field& graph_part) {
  Node node;
  node.raw = graph_part.raw;
  WireReader reader(graph_part.bytes);
  for (Field part; reader.next(part);) {
    if (part.number == field::kNodeInput) node.inputs.push_back(part.bytes);
    if (part.number == field::kNodeOutput) node.outputs.push_back(part.bytes);
    if (part.number == field::kNodeOpType) node.op_type = part.bytes;
    if (part.number == field::kNodeAttribute && !node.axis) node.axis = axis_of(part.bytes);
  }
  return node;
}

std::vector<std::int64_t> read_shape(std::string_view message) {
  std::vector<std::int64_t> shape;
  WireReader dimensions(message);
  for (Field dimension; dimensions.next(dimension);) {
    if (dimension.number != field::kShapeDimension) continue;
    std::int64_t size = -1;  // a name, or nothing: dynamic
    WireReader reader(dimension.bytes);
    for (Field part; reader.next(part);)
      if (part.number == field::kDimensionValue) size = static_cast<std::int64_t>(part.number_value);
    shape.push_back(size > 0 ? size : -1);
  }
  return shape;
}

Tensor read_tensor(std::string_view value_info) {
  Tensor tensor;
  tensor.name = text_of(value_info, field::kValueName);
  WireReader reader(text_of(text_of(value_info, field::kValueType), field::kTypeTensor));
  for (Field part; reader.next(part);) {
    if (part.number == field::kTensorTypeElement) tensor.element_type = static_cast<int>(part.number_value);
    if (part.number == field::kTensorTypeShape) tensor.shape = read_shape(part.bytes);
  }
  return tensor;
}

void read_graph(std::string_view graph, Model& model) {
  std::set<std::string, std::less<>> initializers;
  WireReader reader(graph);
  for (Field part; reader.next(part);) {
    if (part.number == field::kGraphNode) model.nodes.push_back(read_node(part));
    if (part.number == field::kGraphInput) model.inputs.push_back(read_tensor(part.bytes));
    if (part.number == field::kGraphOutput) model.outputs.push_back(read_tensor(part.bytes));
    if (part.number == field::kGraphInitializer)
      initializers.emplace(text_of(part.bytes, field::kTensorName));
  }
  std::erase_if(model.inputs, [&](const Tensor& input) { return initializers.contains(input.name); });
}

}  // namespace

std::string to_string(const Tensor& tensor) {
  std::string text = tensor.name + " [";
  for (std::size_t i = 0; i < tensor.shape.size(); ++i)
    text += (i > 0 ? ", " : "") + (tensor.shape[i] < 0 ? "?" : std::to_string(tensor.shape[i]));
  return text + "]";
}

Model::Model(const std::filesystem::path& onnx_file) try : file(onnx_file), bytes(read_bytes(onnx_file)) {
  WireReader reader(bytes);
  for (Field part; reader.next(part);) {
    if (part.number == field::kModelGraph) read_graph(part.bytes, *this);
    if (part.number == field::kModelMetadata)
      metadata.emplace(text_of(part.bytes, field::kEntryKey), text_of(part.bytes, field::kEntryValue));
  }
  if (nodes.empty()) throw WireError("it has no graph");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::string_view output : nodes[i].outputs) producer_.emplace(output, i);
} catch (const WireError& error) {
  throw std::runtime_error(onnx_file.string() + " is no ONNX network, or truncated: " + error.what());
}

const Node* Model::producer(std::string_view tensor) const {
  const auto found = producer_.find(tensor);
  return found == producer_.end() ? nullptr : &nodes[found->second];
}

}  // namespace sediment::segment::onnx
