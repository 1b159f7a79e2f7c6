#include "tools/synthesize/degraded_masks.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

const char* const kMistaken[] = {"suitcase", "couch", "laptop", "backpack", "bench", "refrigerator"};

/// The pixels of an instance, grown (radius above 0) or shrunk, within `area` of the image.
cv::Mat reshaped(const cv::Mat& ids, int id, const cv::Rect& area, int radius_px) {
  cv::Mat pixels = ids(area) == id;
  if (radius_px == 0) return pixels;
  const int size = 2 * std::abs(radius_px) + 1;
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
  // What lies outside the image never shrinks a mask from its border.
  if (radius_px > 0)
    cv::dilate(pixels, pixels, disc);
  else
    cv::erode(pixels, pixels, disc);
  return pixels;
}

/// Removes instances without a pixel left and fits the boxes to the pixels.
void fit_boxes(InstanceMask& mask) {
  for (Instance& instance : mask.instances) {
    const cv::Rect box = cv::boundingRect(mask.ids == instance.id);
    instance.box_px = {double(box.x), double(box.y), double(box.br().x), double(box.br().y)};
  }
  std::erase_if(mask.instances,
                [](const Instance& instance) { return instance.box_px[2] <= instance.box_px[0]; });
}

}  // namespace

std::vector<bool> missed_frames(std::size_t frame_count, const Degradation& degradation, std::uint64_t seed) {
  std::vector<bool> missed(frame_count, false);
  const auto wanted =
      static_cast<std::size_t>(std::lround(degradation.missed_share * static_cast<double>(frame_count)));
  Random random(hash(seed, 31));
  std::size_t count = 0;
  for (int attempt = 0; attempt < 10000 && count < wanted; ++attempt) {
    const auto length =
        std::min(static_cast<std::size_t>(random.integer(1, degradation.longest_run)), wanted - count);
    if (length > frame_count) continue;
    const std::size_t first = random.next() % (frame_count - length + 1);
    const std::size_t before = first == 0 ? 0 : first - 1, behind = std::min(first + length + 1, frame_count);
    if (std::any_of(missed.begin() + static_cast<long>(before), missed.begin() + static_cast<long>(behind),
                    [](bool m) { return m; }))
      continue;
    std::fill_n(missed.begin() + static_cast<long>(first), length, true);
    count += length;
  }
  return missed;
}

InstanceMask degraded(const InstanceMask& truth, const Degradation& degradation, std::uint64_t seed,
                      std::size_t frame_idx) {
  InstanceMask mask{cv::Mat(truth.ids.size(), CV_16UC1, cv::Scalar(0)), truth.instances};
  const cv::Rect image({}, truth.ids.size());
  const int reach = degradation.boundary_px + 1;
  for (Instance& instance : mask.instances) {
    Random random(hash(seed, 32, frame_idx, static_cast<std::uint64_t>(instance.id)));
    const auto& b = instance.box_px;
    const cv::Rect area =
        cv::Rect(cv::Point(static_cast<int>(b[0]) - reach, static_cast<int>(b[1]) - reach),
                 cv::Point(static_cast<int>(b[2]) + reach, static_cast<int>(b[3]) + reach)) &
        image;
    const int radius_px = random.integer(-degradation.boundary_px, degradation.boundary_px);
    mask.ids(area).setTo(instance.id, reshaped(truth.ids, instance.id, area, radius_px));
    instance.score = 0.35 + 0.6 * random.uniform();
    if (random.chance(degradation.wrong_class_share))
      instance.class_name = kMistaken[random.integer(0, static_cast<int>(std::size(kMistaken)) - 1)];
  }
  fit_boxes(mask);
  return mask;
}

}  // namespace sediment::synthetic
