#include "stages/segment/detections.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace sediment::segment {
namespace {

constexpr int kBoxRows = 4;
constexpr std::size_t kMaxCandidates = 30000;  // Ultralytics' max_nms: bounds the time of a network gone wild

Box box_of(const cv::Mat& anchors, int anchor_idx) {
  const float x = anchors.at<float>(0, anchor_idx), y = anchors.at<float>(1, anchor_idx);
  const float half_width = anchors.at<float>(2, anchor_idx) / 2,
              half_height = anchors.at<float>(3, anchor_idx) / 2;
  return {x - half_width, y - half_height, x + half_width, y + half_height};
}

std::vector<Detection> candidates(const cv::Mat& anchors, const Selection& selection) {
  const auto count = static_cast<std::size_t>(anchors.cols);
  std::vector<float> best(count, 0);
  std::vector<int> class_idx(count, 0);
  for (std::size_t row = 0; row < selection.confidence.size(); ++row) {
    const std::span scores(anchors.ptr<float>(kBoxRows + static_cast<int>(row)), count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!(scores[i] > best[i])) continue;
      best[i] = scores[i];
      class_idx[i] = static_cast<int>(row);
    }
  }
  std::vector<Detection> found;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(best[i] > selection.confidence[static_cast<std::size_t>(class_idx[i])])) continue;
    const auto anchor_idx = static_cast<int>(i);
    const Box box = box_of(anchors, anchor_idx);
    if (std::isfinite(box.area())) found.push_back({class_idx[i], best[i], box, anchor_idx});
  }
  return found;
}

}  // namespace

float overlap(const Box& a, const Box& b) {
  const float width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const float height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  if (!(width > 0 && height > 0)) return 0;
  return width * height / (a.area() + b.area() - width * height);
}

std::vector<Detection> detect(const Prediction& prediction, const Selection& selection) {
  std::vector<Detection> open = candidates(prediction.anchors, selection);
  std::ranges::stable_sort(open, std::ranges::greater{}, &Detection::score);
  open.resize(std::min(open.size(), kMaxCandidates));
  std::vector<Detection> kept;
  for (const Detection& each : open) {
    if (kept.size() == selection.max_detections) break;
    const bool repeats = std::ranges::any_of(kept, [&](const Detection& other) {
      return other.class_idx == each.class_idx && overlap(each.box_px, other.box_px) > selection.iou;
    });
    if (!repeats) kept.push_back(each);
  }
  return kept;
}

}  // namespace sediment::segment
