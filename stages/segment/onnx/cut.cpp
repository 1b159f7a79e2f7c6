#include <algorithm>
#include <optional>
#include <set>

#include "stages/segment/onnx/head.hpp"
#include "stages/segment/onnx/model_fields.hpp"
#include "stages/segment/onnx/wire.hpp"

namespace sediment::segment::onnx {
namespace {

std::string tensor_message(const std::string& name, const std::vector<int>& shape) {
  WireWriter dimensions;
  for (const int size : shape)
    dimensions.bytes(field::kShapeDimension,
                     WireWriter().number(field::kDimensionValue, static_cast<std::uint64_t>(size)).message());
  WireWriter type;
  type.number(field::kTensorTypeElement, std::uint64_t{kFloat32});
  type.bytes(field::kTensorTypeShape, dimensions.message());
  return WireWriter()
      .bytes(field::kValueName, name)
      .bytes(field::kValueType, WireWriter().bytes(field::kTypeTensor, type.message()).message())
      .message();
}

/// The same node by another name.
std::string renamed(const Node& node, const std::string& name) {
  WireReader graph_field(node.raw);
  Field whole;
  graph_field.next(whole);
  WireWriter writer;
  WireReader reader(whole.bytes);
  for (Field part; reader.next(part);)
    if (part.number != field::kNodeName) writer.copy(part.raw);
  return writer.bytes(field::kNodeName, name).message();
}

/// All tensors that the given ones are computed from, and these.
std::set<std::string_view> needed_for(const Model& model, std::vector<std::string_view> open) {
  std::set<std::string_view> needed;
  while (!open.empty()) {
    const std::string_view tensor = open.back();
    open.pop_back();
    if (!needed.insert(tensor).second) continue;
    if (const Node* node = model.producer(tensor))
      open.insert(open.end(), node->inputs.begin(), node->inputs.end());
  }
  return needed;
}

std::string_view initializer_name(std::string_view message) {
  WireReader reader(message);
  for (Field part; reader.next(part);)
    if (part.number == field::kTensorName) return part.bytes;
  return {};
}

/// Name of the first of `outputs` that a node makes; nothing if it makes none.
std::optional<std::string> output_of(const Node& node,
                                     const std::vector<std::pair<std::string, std::string>>& outputs) {
  for (const auto& [tensor, name] : outputs)
    if (std::ranges::find(node.outputs, tensor) != node.outputs.end()) return name;
  return std::nullopt;
}

std::string cut_graph(const Model& model, std::string_view graph, const std::string& input, Size size,
                      const std::vector<std::pair<std::string, std::string>>& outputs) {
  std::vector<std::string_view> targets;
  for (const auto& [tensor, name] : outputs) targets.push_back(tensor);
  const std::set<std::string_view> needed = needed_for(model, targets);

  WireWriter writer;
  for (const Node& node : model.nodes) {
    if (std::ranges::none_of(node.outputs, [&](std::string_view tensor) { return needed.contains(tensor); }))
      continue;
    if (const auto name = output_of(node, outputs))
      writer.bytes(field::kGraphNode, renamed(node, *name));
    else
      writer.copy(node.raw);
  }
  WireReader reader(graph);
  for (Field part; reader.next(part);) {
    const bool weights =
        part.number == field::kGraphInitializer && needed.contains(initializer_name(part.bytes));
    if (weights || part.number == field::kGraphName) writer.copy(part.raw);
  }
  writer.bytes(field::kGraphInput, tensor_message(input, {1, 3, size.height, size.width}));
  for (const auto& [tensor, name] : outputs) writer.bytes(field::kGraphOutput, tensor_message(tensor, {}));
  return writer.message();
}

}  // namespace

std::string cut_before_decoding(const Model& model, const Layout& layout, const Head& head, Size input_size) {
  std::vector<std::pair<std::string, std::string>> outputs = {{head.bins, output_name::kBins}};
  if (head.logits != head.bins) outputs.emplace_back(head.logits, output_name::kLogits);
  outputs.emplace_back(head.coefficients, output_name::kCoefficients);
  outputs.emplace_back(layout.prototypes, output_name::kPrototypes);
  WireWriter writer;
  WireReader reader(model.bytes);
  for (Field part; reader.next(part);) {
    if (part.number == field::kModelGraph)
      writer.bytes(field::kModelGraph, cut_graph(model, part.bytes, layout.input, input_size, outputs));
    else
      writer.copy(part.raw);
  }
  return writer.message();
}

}  // namespace sediment::segment::onnx
