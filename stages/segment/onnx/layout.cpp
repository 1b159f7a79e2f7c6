#include "stages/segment/onnx/layout.hpp"

#include <cctype>
#include <stdexcept>

namespace sediment::segment::onnx {
namespace {

constexpr std::int64_t kBoxValues = 4;

[[noreturn]] void fail(const Model& model, const std::string& what) {
  throw std::runtime_error(model.file.string() + ": " + what);
}

std::string list(const std::vector<Tensor>& tensors) {
  std::string text;
  for (const Tensor& tensor : tensors) text += (text.empty() ? "" : ", ") + to_string(tensor);
  return text;
}

void read_input(const Model& model, Layout& layout) {
  if (model.inputs.size() != 1) fail(model, "expected one input, found " + list(model.inputs));
  const Tensor& input = model.inputs.front();
  const auto& shape = input.shape;
  const bool image = shape.size() == 4 && (shape[1] == 3 || shape[1] == -1);
  if (!image) fail(model, "expected an image [1, 3, height, width] as input, found " + to_string(input));
  if (shape[0] > 1)
    fail(model, "expected one image at a time, found " + to_string(input) + ": export it with batch=1");
  if (input.element_type != kFloat32)
    fail(model, "expected a float32 input, found element type " + std::to_string(input.element_type) +
                    ": export it without half or int8");
  constexpr std::int64_t kMost = 1 << 14;
  if (shape[2] > kMost || shape[3] > kMost) fail(model, "its input is too large: " + to_string(input));
  layout.input = input.name;
  layout.input_size = {static_cast<int>(std::max<std::int64_t>(shape[2], 0)),
                       static_cast<int>(std::max<std::int64_t>(shape[3], 0))};
}

/// The whole numbers in a text: "[480, 640]" -> 480, 640.
std::vector<int> numbers_in(const std::string& text) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!std::isdigit(static_cast<unsigned char>(text[i]))) continue;
    std::size_t length = 0;
    numbers.push_back(std::stoi(text.substr(i, 9), &length));
    i += length;
  }
  return numbers;
}

void read_sizes(const Model& model, Layout& layout) {
  layout.trained_size = {640, 640};
  if (const auto found = model.metadata.find("imgsz"); found != model.metadata.end()) {
    const std::vector<int> sizes = numbers_in(found->second);
    if (!sizes.empty()) layout.trained_size = {sizes.front(), sizes.back()};
  }
  if (const auto found = model.metadata.find("stride"); found != model.metadata.end()) {
    const std::vector<int> strides = numbers_in(found->second);
    if (!strides.empty() && strides.front() > 0) layout.stride = strides.front();
  }
}

std::vector<std::string> names_of(const Model& model, const std::vector<std::string>& given) {
  if (!given.empty()) return given;
  const auto found = model.metadata.find("names");
  if (found == model.metadata.end())
    fail(model, "its metadata has no class names (key `names`): give them with --class-names, in order");
  try {
    return parse_class_names(found->second);
  } catch (const std::runtime_error& error) {
    fail(model, error.what());
  }
}

/// The one pair of outputs that fits the number of classes.
void read_outputs(const Model& model, Layout& layout) {
  const auto classes = static_cast<std::int64_t>(layout.class_names.size());
  for (const Tensor& prototypes : model.outputs) {
    if (prototypes.shape.size() != 4) continue;
    const std::int64_t coefficients = prototypes.shape[1];
    for (const Tensor& anchors : model.outputs) {
      const bool fits = anchors.shape.size() == 3 && coefficients > 0 &&
                        anchors.shape[1] == kBoxValues + classes + coefficients;
      if (!fits) continue;
      layout.anchors = anchors.name;
      layout.prototypes = prototypes.name;
      layout.mask_coefficients = static_cast<int>(coefficients);
      return;
    }
  }
  fail(model, "no YOLOv8-seg or YOLO11-seg outputs for " + std::to_string(classes) +
                  " classes: expected [1, " + std::to_string(kBoxValues + classes) +
                  " + k, anchors] and [1, k, height, width], found " + list(model.outputs) +
                  " (export a -seg network, with nms=False)");
}

}  // namespace

std::vector<std::string> parse_class_names(const std::string& python) {
  std::vector<std::string> names;
  std::string key;
  for (std::size_t i = 0; i < python.size(); ++i) {
    if (std::isdigit(static_cast<unsigned char>(python[i]))) key += python[i];
    if (python[i] != '\'' && python[i] != '"') continue;
    const char quote = python[i++];
    std::string name;
    for (; i < python.size() && python[i] != quote; ++i) {
      if (python[i] == '\\' && i + 1 < python.size()) ++i;  // \' and \\; other escapes do not occur in names
      name += python[i];
    }
    const bool closed = i < python.size();
    if (!closed || name.empty() || (!key.empty() && key != std::to_string(names.size())))
      throw std::runtime_error("class names: expected {0: 'a', 1: 'b', ...}, found an error at index " +
                               std::to_string(names.size()));
    names.push_back(std::move(name));
    key.clear();
  }
  if (names.empty()) throw std::runtime_error("class names: expected {0: 'a', ...}, found " + python);
  return names;
}

Layout read_layout(const Model& model, const std::vector<std::string>& class_names) {
  Layout layout;
  read_input(model, layout);
  read_sizes(model, layout);
  layout.class_names = names_of(model, class_names);
  read_outputs(model, layout);
  return layout;
}

}  // namespace sediment::segment::onnx
