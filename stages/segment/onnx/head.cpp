#include "stages/segment/onnx/head.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <set>
#include <stdexcept>

namespace sediment::segment::onnx {
namespace {

[[noreturn]] void no_head(const Model& model, const std::string& what) {
  throw std::runtime_error(model.file.string() + ": " + what +
                           ": the graph does not end in the head of a YOLOv8-seg or YOLO11-seg export, "
                           "the engine opencv cannot run it");
}

/// The tensors that are stacked in rows to make a tensor, nested stacks resolved, top to bottom.
/// (Concatenation of the levels' anchors is along the other axis.)
void unstack(const Model& model, std::string_view tensor, std::vector<std::string_view>& parts) {
  const Node* node = model.producer(tensor);
  const bool stacked = node != nullptr && node->op_type == "Concat" && (node->axis == 1 || node->axis == -2);
  if (!stacked) return parts.push_back(tensor);
  for (const std::string_view input : node->inputs) unstack(model, input, parts);
}

/// The nearest node of a type at or before a tensor, in number of nodes between.
const Node* nearest_before(const Model& model, std::string_view tensor, std::string_view op_type) {
  std::deque<std::string_view> open{tensor};
  std::set<std::string_view> seen;
  for (; !open.empty(); open.pop_front()) {
    const Node* node = model.producer(open.front());
    if (node == nullptr || !seen.insert(open.front()).second) continue;
    if (node->op_type == op_type) return node;
    open.insert(open.end(), node->inputs.begin(), node->inputs.end());
  }
  return nullptr;
}

/// The tensor before the nodes that only arrange values anew or, with `splits`, take a part of them.
std::string_view before(const Model& model, std::string_view tensor, bool splits) {
  static constexpr std::array kArranging = {"Transpose", "Reshape", "Identity", "Unsqueeze", "Squeeze"};
  for (const Node* node = model.producer(tensor); node != nullptr; node = model.producer(tensor)) {
    const bool passes = std::ranges::find(kArranging, node->op_type) != kArranging.end() ||
                        (splits && (node->op_type == "Split" || node->op_type == "Slice"));
    if (!passes) break;
    tensor = node->inputs.at(0);
  }
  return tensor;
}

}  // namespace

Head find_head(const Model& model, const Layout& layout) {
  std::vector<std::string_view> parts;
  unstack(model, layout.anchors, parts);
  const auto scores = std::ranges::find_if(parts, [&](std::string_view part) {
    const Node* node = model.producer(part);
    return node != nullptr && node->op_type == "Sigmoid";
  });
  if (scores == parts.begin() || parts.end() - scores != 2)
    no_head(model, layout.anchors + " is not made of boxes, class scores and mask coefficients");
  const Node* softmax = nearest_before(model, parts.front(), "Softmax");
  if (softmax == nullptr) no_head(model, "no softmax over the bins of the boxes before " + layout.anchors);

  Head head;
  head.bins = before(model, softmax->inputs.at(0), true);
  head.logits = before(model, model.producer(*scores)->inputs.at(0), true);
  head.coefficients = parts.back();
  return head;
}

}  // namespace sediment::segment::onnx
