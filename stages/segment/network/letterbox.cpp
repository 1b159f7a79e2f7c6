#include "stages/segment/network/letterbox.hpp"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace sediment::segment {
namespace {

constexpr int kBorder = 114;

/// Python's round(): halves to even.
int round_half_even(double value) {
  return static_cast<int>(std::nearbyint(value));
}

std::array<float, 256> unit_scale() {
  std::array<float, 256> table{};
  for (std::size_t value = 0; value < table.size(); ++value)
    table[value] = static_cast<float>(value) / 255.0f;
  return table;
}

}  // namespace

Letterbox fit(cv::Size image, cv::Size input) {
  Letterbox box;
  box.image = image;
  box.input = input;
  box.scale = std::min(static_cast<double>(input.height) / image.height,
                       static_cast<double>(input.width) / image.width);
  box.scaled = {round_half_even(image.width * box.scale), round_half_even(image.height * box.scale)};
  // An odd border has its extra pixel at the right and at the bottom.
  box.left = round_half_even((input.width - box.scaled.width) / 2.0 - 0.1);
  box.top = round_half_even((input.height - box.scaled.height) / 2.0 - 0.1);
  return box;
}

cv::Size smallest_input(cv::Size image, int longest, int stride) {
  const double scale = static_cast<double>(longest) / std::max(image.height, image.width);
  const auto multiple = [&](int size) {
    const int scaled = round_half_even(size * scale);
    return (scaled + stride - 1) / stride * stride;
  };
  return {multiple(image.width), multiple(image.height)};
}

cv::Mat to_input(const cv::Mat& bgr, const Letterbox& letterbox) {
  if (bgr.size() != letterbox.image || bgr.type() != CV_8UC3)
    throw std::invalid_argument("the image is not of the size the network was set up for");
  static const std::array<float, 256> unit = unit_scale();
  cv::Mat scaled = bgr;
  if (letterbox.scaled != letterbox.image) cv::resize(bgr, scaled, letterbox.scaled, 0, 0, cv::INTER_LINEAR);

  const std::array shape = {1, 3, letterbox.input.height, letterbox.input.width};
  cv::Mat tensor(static_cast<int>(shape.size()), shape.data(), CV_32F);
  if (letterbox.scaled != letterbox.input) tensor = cv::Scalar::all(unit[kBorder]);
  for (int y = 0; y < scaled.rows; ++y) {
    const auto* from = scaled.ptr<cv::Vec3b>(y);
    std::array<float*, 3> to{};  // red, green, blue
    for (int channel = 0; channel < 3; ++channel)
      to[static_cast<std::size_t>(channel)] = tensor.ptr<float>(0, channel) +
                                              static_cast<std::ptrdiff_t>(y + letterbox.top) * shape[3] +
                                              letterbox.left;
    for (int x = 0; x < scaled.cols; ++x) {
      to[0][x] = unit[from[x][2]];
      to[1][x] = unit[from[x][1]];
      to[2][x] = unit[from[x][0]];
    }
  }
  return tensor;
}

}  // namespace sediment::segment
