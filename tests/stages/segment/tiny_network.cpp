#include "tests/stages/segment/tiny_network.hpp"

#include <fstream>

#include "tests/stages/segment/onnx_builder.hpp"

namespace sediment::test {
namespace {

using Names = std::vector<std::string>;

constexpr int kBins = 16, kClasses = 2, kCoefficients = 3;
constexpr float kNever = -100;

/// Logits of the bins whose mean is 0.5, 0.5, 1.5 and 1 strides.
std::vector<float> bin_logits() {
  std::vector<float> logits(4 * kBins, kNever);
  for (const int bin : {0, 1, kBins, kBins + 1, 2 * kBins + 1, 2 * kBins + 2, 3 * kBins + 1})
    logits[static_cast<std::size_t>(bin)] = 0;
  return logits;
}

/// A 1 x 1 convolution of the three colours: weights row by row, then the biases.
void colors_to(OnnxBuilder& build, const std::string& from, const std::string& to,
               const std::vector<float>& weights, const std::vector<float>& biases) {
  const auto rows = static_cast<std::int64_t>(biases.size());
  build.floats(to + "_weights", {rows, 3, 1, 1}, weights);
  build.floats(to + "_biases", {rows}, biases);
  build.node("Conv", {from, to + "_weights", to + "_biases"}, {to}, {{"kernel_shape", {1, 1}}});
}

void average(OnnxBuilder& build, int size, const std::string& to) {
  build.node("AveragePool", {"images"}, {to}, {{"kernel_shape", {size, size}}, {"strides", {size, size}}});
}

void reshape(OnnxBuilder& build, const std::string& from, const std::string& to,
             const std::vector<std::int64_t>& shape) {
  build.integers(to + "_shape", shape);
  build.node("Reshape", {from, to + "_shape"}, {to});
}

/// As an export with dynamic axes writes view(x.shape[0], rows, -1).
void reshape_by_batch(OnnxBuilder& build, const std::string& from, const std::string& to, std::int64_t rows) {
  build.node("Shape", {from}, {to + "_from"});
  build.integers(to + "_zero", {0});
  build.node("Gather", {to + "_from", to + "_zero"}, {to + "_batch"}, {{"axis", {0}, false}});
  build.integers(to + "_rest", {rows, -1});
  build.node("Concat", {to + "_batch", to + "_rest"}, {to + "_shape"}, {{"axis", {0}, false}});
  build.node("Reshape", {from, to + "_shape"}, {to});
}

void concat(OnnxBuilder& build, const Names& from, const std::string& to, std::int64_t axis) {
  build.node("Concat", from, {to}, {{"axis", {axis}, false}});
}

/// Self-attention over the cells of a level as YOLO11 has it, one head of three channels, added to the cells.
void add_attention(OnnxBuilder& build, const std::string& cells, cv::Size size) {
  colors_to(build, cells, "qkv_map",
            {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 0, 2, 2, 0, 0, 2, -1, -1, -1, 2, -1, -1, -1, 2},
            std::vector<float>(9, 0.1f));
  reshape(build, "qkv_map", "qkv", {1, 1, 9, size.area()});
  build.integers("qkv_parts", {3, 3, 3});
  build.node("Split", {"qkv", "qkv_parts"}, {"q", "k", "v"}, {{"axis", {2}, false}});
  build.node("Transpose", {"q"}, {"q_transposed"}, {{"perm", {0, 1, 3, 2}}});
  build.node("MatMul", {"q_transposed", "k"}, {"affinity"});
  build.floats("attention_scale", {1}, {0.5f});
  build.node("Mul", {"affinity", "attention_scale"}, {"scaled_affinity"});
  build.node("Softmax", {"scaled_affinity"}, {"attention"}, {{"axis", {-1}, false}});
  build.node("Transpose", {"attention"}, {"attention_transposed"}, {{"perm", {0, 1, 3, 2}}});
  build.node("MatMul", {"v", "attention_transposed"}, {"attended_row"});
  reshape(build, "attended_row", "attended", {1, 3, size.height, size.width});
  build.node("Add", {cells, "attended"}, {cells + "_attended"});
}

/// Bins, logits and coefficients of the anchors of one stride.
void add_level(OnnxBuilder& build, int stride, const TinyNetwork& network) {
  const std::string level = std::to_string(stride);
  average(build, stride, "cells" + level);
  std::string cells = "cells" + level;
  if (network.attention && stride == 32) {
    add_attention(build, cells, network.input / 32);
    cells += "_attended";
  }
  colors_to(build, cells, "bin_map" + level, std::vector<float>(4 * kBins * 3, 0), bin_logits());
  const float bias = stride == 32 ? -10 : kNever;
  colors_to(build, cells, "logit_map" + level, {20, -20, -20, -20, 20, -20}, {bias, bias});
  colors_to(build, cells, "coefficient_map" + level, std::vector<float>(kCoefficients * 3, 0), {0, 2, 0});
  reshape(build, "coefficient_map" + level, "coefficients" + level, {1, kCoefficients, -1});
}

/// Concatenates the levels to `bins` and `logits`, in one of the two ways exports have.
void join_levels(OnnxBuilder& build, const TinyNetwork& network) {
  const auto flatten = [&](const std::string& from, const std::string& to, std::int64_t rows) {
    if (network.dynamic) return reshape_by_batch(build, from, to, rows);
    reshape(build, from, to, {1, rows, -1});
  };
  Names bins, logits, both;
  for (const std::string level : {"8", "16", "32"}) {
    if (network.split) {
      concat(build, {"bin_map" + level, "logit_map" + level}, "both_map" + level, 1);
      flatten("both_map" + level, "both" + level, 4 * kBins + kClasses);
    } else {
      flatten("bin_map" + level, "bins" + level, 4 * kBins);
      flatten("logit_map" + level, "logits" + level, kClasses);
    }
    bins.push_back("bins" + level);
    logits.push_back("logits" + level);
    both.push_back("both" + level);
  }
  if (network.split) {
    concat(build, both, "both", 2);
    build.integers("parts", {4 * kBins, kClasses});
    build.node("Split", {"both", "parts"}, {"bins", "logits"}, {{"axis", {1}, false}});
  } else {
    concat(build, bins, "bins", -1);
    concat(build, logits, "logits", -1);
  }
}

/// Centres of the anchors in strides (x, then y), and their strides, as constants.
void add_anchor_constants(OnnxBuilder& build, cv::Size input) {
  std::vector<float> x, y, strides;
  for (const int stride : {8, 16, 32})
    for (int row = 0; row < input.height / stride; ++row)
      for (int column = 0; column < input.width / stride; ++column) {
        x.push_back(static_cast<float>(column) + 0.5f);
        y.push_back(static_cast<float>(row) + 0.5f);
        strides.push_back(static_cast<float>(stride));
      }
  const auto count = static_cast<std::int64_t>(x.size());
  x.insert(x.end(), y.begin(), y.end());
  build.floats("centres", {1, 2, count}, x);
  build.floats("strides", {1, 1, count}, strides);
}

/// The decoding of boxes as Ultralytics exports it.
void decode_boxes(OnnxBuilder& build) {
  reshape(build, "bins", "sides_of_bins", {1, 4, kBins, -1});
  build.node("Transpose", {"sides_of_bins"}, {"bins_of_sides"}, {{"perm", {0, 2, 1, 3}}});
  build.node("Softmax", {"bins_of_sides"}, {"weights_of_bins"}, {{"axis", {1}, false}});
  std::vector<float> indices;
  for (int bin = 0; bin < kBins; ++bin) indices.push_back(static_cast<float>(bin));
  build.floats("bin_indices", {1, kBins, 1, 1}, indices);
  build.node("Conv", {"weights_of_bins", "bin_indices"}, {"mean_bins"}, {{"kernel_shape", {1, 1}}});
  reshape(build, "mean_bins", "distances", {1, 4, -1});
  build.integers("halves", {2, 2});
  build.node("Split", {"distances", "halves"}, {"left_top", "right_bottom"}, {{"axis", {1}, false}});
  build.node("Sub", {"centres", "left_top"}, {"first_corner"});
  build.node("Add", {"centres", "right_bottom"}, {"second_corner"});
  build.node("Add", {"first_corner", "second_corner"}, {"twice_middle"});
  build.floats("two", {1}, {2});
  build.node("Div", {"twice_middle", "two"}, {"middle"});
  build.node("Sub", {"second_corner", "first_corner"}, {"extent"});
  concat(build, {"middle", "extent"}, "boxes_in_strides", 1);
  build.node("Mul", {"boxes_in_strides", "strides"}, {"boxes"});
}

void declare_outputs(OnnxBuilder& build, const TinyNetwork& network) {
  const int height = network.input.height, width = network.input.width;
  const std::int64_t count = network.dynamic ? -1 : height * width * 21 / 1024;
  const std::int64_t rows = 4 + kClasses + (network.segments ? kCoefficients : 0);
  const auto anchors = [&] { build.output("second", {1, rows, count}); };
  const auto prototypes = [&] {
    if (network.segments)
      build.output("first",
                   {1, kCoefficients, network.dynamic ? -1 : height / 4, network.dynamic ? -1 : width / 4});
  };
  if (network.swapped) prototypes();
  anchors();
  if (!network.swapped) prototypes();
}

}  // namespace

std::string onnx_file(const TinyNetwork& network) {
  OnnxBuilder build;
  const auto size = [&](int pixels) { return network.dynamic ? std::int64_t{-1} : std::int64_t{pixels}; };
  build.input("images", network.element_type,
              {network.batch, 3, size(network.input.height), size(network.input.width)});
  for (const int stride : {8, 16, 32}) add_level(build, stride, network);
  join_levels(build, network);
  concat(build, {"coefficients8", "coefficients16", "coefficients32"}, "coefficients", 2);
  add_anchor_constants(build, network.input);
  decode_boxes(build);
  build.node("Sigmoid", {"logits"}, {"scores"});
  concat(build, network.segments ? Names{"boxes", "scores", "coefficients"} : Names{"boxes", "scores"},
         "second", 1);
  average(build, 4, "tiles");
  // Only the second prototype counts: logit 2 * (10 (red + green) - 5).
  colors_to(build, "tiles", "first", {3, 3, 3, 10, 10, 0, -7, 1, 2}, {9, -5, 1});
  declare_outputs(build, network);
  if (!network.names.empty()) build.metadata("names", network.names);
  build.metadata("stride", "32");
  build.metadata(
      "imgsz", "[" + std::to_string(network.input.height) + ", " + std::to_string(network.input.width) + "]");
  return build.file();
}

void write_onnx(const std::filesystem::path& file, const TinyNetwork& network) {
  std::ofstream(file, std::ios::binary) << onnx_file(network);
}

cv::Rect box_at(cv::Point corner, cv::Size image) {
  return cv::Rect(corner.x, corner.y, 64, 48) & cv::Rect({}, image);
}

}  // namespace sediment::test
