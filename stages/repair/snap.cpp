#include "stages/repair/snap.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace sediment::repair {
namespace {

/// Pixels whose side of the outline is not certain.
cv::Mat band_around(const cv::Mat& share, int radius_px) {
  const cv::Mat inside = share > 0.5, square = cv::Mat::ones(2 * radius_px + 1, 2 * radius_px + 1, CV_8U);
  cv::Mat grown, shrunk;
  cv::dilate(inside, grown, square);
  cv::erode(inside, shrunk, square);
  return grown & ~shrunk;
}

}  // namespace

void snap(SoftMask& mask, const Guide& guide, int rounds) {
  if (guide.radius_px <= 0) return;
  for (int round = 0; round < rounds; ++round)
    mask.share = mean_of_like(mask.share, mask.where, band_around(mask.share, guide.radius_px), guide);
}

InstanceMask harden(const std::vector<SoftMask>& masks, cv::Size size) {
  InstanceMask hard{cv::Mat(size, CV_16UC1, cv::Scalar(0)), {}};
  cv::Mat best(size, CV_32FC1, cv::Scalar(0.5));
  for (const SoftMask& mask : masks)
    for (int y = 0; y < mask.where.height; ++y)
      for (int x = 0; x < mask.where.width; ++x) {
        const cv::Point at(mask.where.x + x, mask.where.y + y);
        if (mask.share.at<float>(y, x) <= best.at<float>(at)) continue;
        best.at<float>(at) = mask.share.at<float>(y, x);
        hard.ids.at<std::uint16_t>(at) = static_cast<std::uint16_t>(mask.track + 1);
      }
  for (const SoftMask& mask : masks) {
    const cv::Rect box = cv::boundingRect(hard.ids(mask.where) == mask.track + 1) + mask.where.tl();
    if (box.empty()) continue;
    Instance instance{mask.track + 1, {}, mask.score};
    instance.box_px = {static_cast<double>(box.x), static_cast<double>(box.y),
                       static_cast<double>(box.x + box.width), static_cast<double>(box.y + box.height)};
    hard.instances.push_back(std::move(instance));
  }
  return hard;
}

}  // namespace sediment::repair
