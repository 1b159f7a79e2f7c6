#include "stages/segment/instance_masks.hpp"

#include <algorithm>
#include <cmath>

namespace sediment::segment {
namespace {

/// Where a pixel lies between two prototypes.
struct Between {
  int first = 0, second = 0;
  float weight = 0;  ///< of the second
};

/// For each pixel of an image axis: scaled by `scaled / image`, shifted by `border`, then `mask / input` of
/// the prototypes' axis. Pixel centres lie at halves, ends are repeated (torch's align_corners=False).
std::vector<Between> positions(int image, int scaled, int border, int input, int mask) {
  std::vector<Between> found;
  for (int i = 0; i < image; ++i) {
    const double in_input = (i + 0.5) * scaled / image + border;
    const double in_mask = std::clamp(in_input * mask / input - 0.5, 0.0, mask - 1.0);
    const int first = static_cast<int>(in_mask);
    found.push_back({first, std::min(first + 1, mask - 1), static_cast<float>(in_mask - first)});
  }
  return found;
}

Box to_image(const Box& box, const Letterbox& letterbox) {
  const auto axis = [&](float value, int border, int size) {
    return std::clamp(static_cast<float>((value - static_cast<float>(border)) / letterbox.scale), 0.0f,
                      static_cast<float>(size));
  };
  return {axis(box.left, letterbox.left, letterbox.image.width),
          axis(box.top, letterbox.top, letterbox.image.height),
          axis(box.right, letterbox.left, letterbox.image.width),
          axis(box.bottom, letterbox.top, letterbox.image.height)};
}

/// The pixels of the image whose centres lie inside a box that is rounded to whole pixels of the input:
/// halves to even, as Ultralytics' crop_mask.
cv::Rect pixels_in(const Box& box, const Letterbox& letterbox) {
  const auto first = [](float side, int border, int scaled, int image) {
    const double in_image = (std::nearbyint(side) - border) * image / scaled;
    return static_cast<int>(std::clamp(std::ceil(in_image - 0.5), 0.0, static_cast<double>(image)));
  };
  const auto column = [&](float side) {
    return first(side, letterbox.left, letterbox.scaled.width, letterbox.image.width);
  };
  const auto row = [&](float side) {
    return first(side, letterbox.top, letterbox.scaled.height, letterbox.image.height);
  };
  return {cv::Point(column(box.left), row(box.top)),
          cv::Point(std::max(column(box.left), column(box.right)), std::max(row(box.top), row(box.bottom)))};
}

/// Assembles the masks of one image.
class Assembler {
 public:
  Assembler(const Prediction& prediction, const Letterbox& box)
      : prediction_(prediction),
        columns_(positions(box.image.width, box.scaled.width, box.left, box.input.width,
                           prediction.mask_size.width)),
        rows_(positions(box.image.height, box.scaled.height, box.top, box.input.height,
                        prediction.mask_size.height)) {}

  /// CV_8UC1 of the window's size.
  cv::Mat mask(int anchor_idx, const cv::Rect& window) const {
    const cv::Rect part = prototypes_under(window);
    const cv::Mat wide = widened(probabilities(anchor_idx, part), part, window);
    cv::Mat pixels(window.size(), CV_8UC1);
    for (int y = 0; y < window.height; ++y) {
      const auto [first, second, weight] = rows_[static_cast<std::size_t>(window.y + y)];
      const float* above = wide.ptr<float>(first - part.y);
      const float* below = wide.ptr<float>(second - part.y);
      auto* row = pixels.ptr<std::uint8_t>(y);
      for (int x = 0; x < window.width; ++x)
        row[x] = above[x] + (below[x] - above[x]) * weight > 0.5f ? 255 : 0;
    }
    return pixels;
  }

 private:
  cv::Rect prototypes_under(const cv::Rect& window) const {
    const auto at = [](const std::vector<Between>& axis, int i) { return axis[static_cast<std::size_t>(i)]; };
    return {cv::Point(at(columns_, window.x).first, at(rows_, window.y).first),
            cv::Point(at(columns_, window.br().x - 1).second + 1, at(rows_, window.br().y - 1).second + 1)};
  }

  cv::Mat probabilities(int anchor_idx, const cv::Rect& part) const {
    const int count = prediction_.prototypes.rows;
    cv::Mat sums = cv::Mat::zeros(part.size(), CV_32F);
    for (int k = 0; k < count; ++k) {
      const float coefficient =
          prediction_.anchors.at<float>(prediction_.anchors.rows - count + k, anchor_idx);
      for (int y = 0; y < part.height; ++y) {
        const float* prototype = prediction_.prototypes.ptr<float>(k) +
                                 static_cast<std::ptrdiff_t>(part.y + y) * prediction_.mask_size.width +
                                 part.x;
        float* sum = sums.ptr<float>(y);
        for (int x = 0; x < part.width; ++x) sum[x] += coefficient * prototype[x];
      }
    }
    std::for_each(sums.begin<float>(), sums.end<float>(), [](float& sum) { sum = 1 / (1 + std::exp(-sum)); });
    return sums;
  }

  /// Interpolated along the rows.
  cv::Mat widened(const cv::Mat& narrow, const cv::Rect& part, const cv::Rect& window) const {
    cv::Mat wide(part.height, window.width, CV_32F);
    for (int y = 0; y < part.height; ++y) {
      const float* from = narrow.ptr<float>(y);
      float* to = wide.ptr<float>(y);
      for (int x = 0; x < window.width; ++x) {
        const auto [first, second, weight] = columns_[static_cast<std::size_t>(window.x + x)];
        const float a = from[first - part.x], b = from[second - part.x];
        to[x] = a + (b - a) * weight;
      }
    }
    return wide;
  }

  const Prediction& prediction_;
  std::vector<Between> columns_, rows_;
};

}  // namespace

std::vector<ObjectMask> assemble(const Prediction& prediction, const std::vector<Detection>& detections,
                                 const Letterbox& letterbox, const std::vector<std::string>& class_names) {
  const Assembler assembler(prediction, letterbox);
  std::vector<ObjectMask> objects;
  for (const Detection& detection : detections) {
    const Box box = to_image(detection.box_px, letterbox);
    const cv::Rect window = pixels_in(detection.box_px, letterbox);
    if (window.empty()) continue;
    ObjectMask object{.class_name = class_names.at(static_cast<std::size_t>(detection.class_idx)),
                      .score = detection.score,
                      .box_px = {box.left, box.top, box.right, box.bottom},
                      .window = window,
                      .pixels = assembler.mask(detection.anchor_idx, window)};
    if (cv::countNonZero(object.pixels) > 0) objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace sediment::segment
