#include "tests/stages/segment/onnx_builder.hpp"

#include <cstring>

#include "stages/segment/onnx/model_fields.hpp"

namespace sediment::test {
namespace {

namespace field = segment::onnx::field;
using segment::onnx::WireWriter;

constexpr std::uint64_t kFloat = 1, kInt64 = 7, kAttributeInt = 2, kAttributeInts = 7;

template <class Value>
std::string raw(const std::vector<Value>& values) {
  std::string bytes(values.size() * sizeof(Value), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string tensor(const std::string& name, std::uint64_t type, const std::vector<std::int64_t>& shape,
                   const std::string& values) {
  WireWriter writer;
  for (const std::int64_t size : shape) writer.number(1, static_cast<std::uint64_t>(size));
  return writer.number(2, type).bytes(field::kTensorName, name).bytes(9, values).message();
}

std::string value(const std::string& name, int element_type, const std::vector<std::int64_t>& shape) {
  WireWriter sizes;
  for (const std::int64_t size : shape) {
    WireWriter dimension;
    if (size < 0)
      dimension.bytes(2, "dynamic_" + name + std::to_string(sizes.message().size()));
    else
      dimension.number(field::kDimensionValue, static_cast<std::uint64_t>(size));
    sizes.bytes(field::kShapeDimension, dimension.message());
  }
  const std::string type = WireWriter()
                               .number(field::kTensorTypeElement, static_cast<std::uint64_t>(element_type))
                               .bytes(field::kTensorTypeShape, sizes.message())
                               .message();
  return WireWriter()
      .bytes(field::kValueName, name)
      .bytes(field::kValueType, WireWriter().bytes(field::kTypeTensor, type).message())
      .message();
}

std::string attribute_message(const OnnxBuilder::Attribute& attribute) {
  WireWriter writer;
  writer.bytes(field::kAttributeName, attribute.name);
  if (!attribute.list)
    return writer.number(field::kAttributeInt, static_cast<std::uint64_t>(attribute.values.front()))
        .number(20, kAttributeInt)
        .message();
  for (const std::int64_t each : attribute.values) writer.number(8, static_cast<std::uint64_t>(each));
  return writer.number(20, kAttributeInts).message();
}

}  // namespace

void OnnxBuilder::floats(const std::string& name, const std::vector<std::int64_t>& shape,
                         const std::vector<float>& values) {
  graph_.bytes(field::kGraphInitializer, tensor(name, kFloat, shape, raw(values)));
}

void OnnxBuilder::integers(const std::string& name, const std::vector<std::int64_t>& values) {
  graph_.bytes(field::kGraphInitializer,
               tensor(name, kInt64, {static_cast<std::int64_t>(values.size())}, raw(values)));
}

void OnnxBuilder::node(const std::string& op_type, const std::vector<std::string>& inputs,
                       const std::vector<std::string>& outputs, const std::vector<Attribute>& attributes) {
  WireWriter writer;
  for (const std::string& input : inputs) writer.bytes(field::kNodeInput, input);
  for (const std::string& output : outputs) writer.bytes(field::kNodeOutput, output);
  writer.bytes(field::kNodeName, "node_" + outputs.front()).bytes(field::kNodeOpType, op_type);
  for (const Attribute& each : attributes) writer.bytes(field::kNodeAttribute, attribute_message(each));
  graph_.bytes(field::kGraphNode, writer.message());
}

void OnnxBuilder::input(const std::string& name, int element_type, const std::vector<std::int64_t>& shape) {
  graph_.bytes(field::kGraphInput, value(name, element_type, shape));
}

void OnnxBuilder::output(const std::string& name, const std::vector<std::int64_t>& shape) {
  graph_.bytes(field::kGraphOutput, value(name, kFloat, shape));
}

void OnnxBuilder::metadata(const std::string& key, const std::string& text) {
  model_tail_.bytes(field::kModelMetadata,
                    WireWriter().bytes(field::kEntryKey, key).bytes(field::kEntryValue, text).message());
}

std::string OnnxBuilder::file() const {
  WireWriter model;
  model.number(1, 8).bytes(field::kModelGraph,
                           WireWriter().copy(graph_.message()).bytes(2, "tiny").message());
  model.bytes(8, WireWriter().bytes(1, "").number(2, 13).message());
  return model.copy(model_tail_.message()).message();
}

}  // namespace sediment::test
