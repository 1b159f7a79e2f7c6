#include "tools/render/colors.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace sediment::render {

cv::Vec3b label_color(std::uint32_t label, cv::Vec3b image_bgr, const LabelTable& labels) {
  const double grey = 0.114 * image_bgr[0] + 0.587 * image_bgr[1] + 0.299 * image_bgr[2];
  const Label* found = label == kUnlabelled ? nullptr : labels.find(label);
  if (found == nullptr) {
    const auto pale = cv::saturate_cast<std::uint8_t>(95 + 0.45 * grey);
    return {pale, pale, pale};
  }
  const double light = 0.72 + 0.28 * grey / 160;
  return {cv::saturate_cast<std::uint8_t>(found->rgb[2] * light),
          cv::saturate_cast<std::uint8_t>(found->rgb[1] * light),
          cv::saturate_cast<std::uint8_t>(found->rgb[0] * light)};
}

cv::Vec3b scale_color(double share) {
  static const cv::Mat scale = [] {
    cv::Mat ramp(256, 1, CV_8UC1), colors;
    for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
    cv::applyColorMap(ramp, colors, cv::COLORMAP_TURBO);
    return colors;
  }();
  return scale.at<cv::Vec3b>(static_cast<int>(std::clamp(share, 0.0, 1.0) * 255), 0);
}

double HeightRange::share(double height_m) const {
  return (height_m - low_m) / std::max(high_m - low_m, 1e-6);
}

HeightRange height_range(std::span<const double> heights_m) {
  if (heights_m.empty()) return {};
  std::vector<double> sorted(heights_m.begin(), heights_m.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t margin = sorted.size() / 200;
  return {sorted[margin], sorted[sorted.size() - 1 - margin]};
}

}  // namespace sediment::render
