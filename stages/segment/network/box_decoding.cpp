#include "stages/segment/network/box_decoding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

namespace sediment::segment {
namespace {

/// Levels of the networks there are: the usual ones, and with a finer or a coarser one (P2, P6).
const std::vector<std::vector<int>> kStrides = {{8, 16, 32}, {4, 8, 16, 32}, {8, 16, 32, 64}};

/// Centre of an anchor and pixels per unit of distance.
struct Anchor {
  float x = 0, y = 0, stride = 0;
};

int count_anchors(cv::Size input, const std::vector<int>& strides) {
  int count = 0;
  for (const int stride : strides) count += (input.height / stride) * (input.width / stride);
  return count;
}

std::vector<Anchor> anchors_of(cv::Size input, const std::vector<int>& strides) {
  std::vector<Anchor> anchors;
  for (const int stride : strides)
    for (int row = 0; row < input.height / stride; ++row)
      for (int column = 0; column < input.width / stride; ++column)
        anchors.push_back(
            {static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f, static_cast<float>(stride)});
  return anchors;
}

/// Mean of the bins' indices under their softmax, for all anchors: row by row, so that it runs over memory in
/// order.
std::vector<float> distances(const cv::Mat& bins) {
  const auto count = static_cast<std::size_t>(bins.cols);
  std::vector<float> highest(bins.ptr<float>(0), bins.ptr<float>(0) + count);
  for (int bin = 1; bin < bins.rows; ++bin)
    std::ranges::transform(highest, std::span(bins.ptr<float>(bin), count), highest.begin(),
                           [](float a, float b) { return std::max(a, b); });
  std::vector<float> sum(count, 0), weighted(count, 0);
  for (int bin = 0; bin < bins.rows; ++bin) {
    const float* row = bins.ptr<float>(bin);
    for (std::size_t i = 0; i < count; ++i) {
      const float weight = std::exp(row[i] - highest[i]);
      sum[i] += weight;
      weighted[i] += weight * static_cast<float>(bin);
    }
  }
  for (std::size_t i = 0; i < count; ++i) weighted[i] /= sum[i];
  return weighted;
}

void decode_boxes(const cv::Mat& bins, const std::vector<Anchor>& anchors, cv::Mat& out) {
  const int bins_per_side = bins.rows / 4;
  std::array<std::vector<float>, 4> sides;  // left, top, right, bottom
  for (int side = 0; side < 4; ++side)
    sides[static_cast<std::size_t>(side)] =
        distances(bins.rowRange(side * bins_per_side, (side + 1) * bins_per_side));
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    const auto [x, y, stride] = anchors[i];
    const float left = x - sides[0][i], top = y - sides[1][i];
    const float right = x + sides[2][i], bottom = y + sides[3][i];
    const auto column = static_cast<int>(i);
    out.at<float>(0, column) = (left + right) / 2 * stride;
    out.at<float>(1, column) = (top + bottom) / 2 * stride;
    out.at<float>(2, column) = (right - left) * stride;
    out.at<float>(3, column) = (bottom - top) * stride;
  }
}

}  // namespace

cv::Mat decode(const RawHead& head, cv::Size input_size) {
  const int count = head.bins.cols;
  const auto strides = std::ranges::find_if(
      kStrides, [&](const std::vector<int>& each) { return count_anchors(input_size, each) == count; });
  if (strides == kStrides.end() || head.logits.cols != count || head.coefficients.cols != count)
    throw std::runtime_error("expected " + std::to_string(count_anchors(input_size, kStrides.front())) +
                             " anchors (strides 8, 16, 32), found " + std::to_string(count));
  const std::vector<Anchor> anchors = anchors_of(input_size, *strides);
  if (head.bins.rows == 0 || head.bins.rows % 4 != 0)
    throw std::runtime_error("expected bins for 4 sides, found " + std::to_string(head.bins.rows) + " rows");

  const int classes = head.logits.rows;
  cv::Mat out(4 + classes + head.coefficients.rows, count, CV_32F);
  decode_boxes(head.bins, anchors, out);
  for (int row = 0; row < classes; ++row)
    std::transform(head.logits.ptr<float>(row), head.logits.ptr<float>(row) + count, out.ptr<float>(4 + row),
                   [](float logit) { return 1 / (1 + std::exp(-logit)); });
  head.coefficients.copyTo(out.rowRange(4 + classes, out.rows));
  return out;
}

}  // namespace sediment::segment
