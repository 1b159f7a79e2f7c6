#include "stages/repair/snap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

namespace sediment::repair {
namespace {

constexpr double kColorSigma = 18;     ///< grey levels, over the three channels together
constexpr float kWithoutDepth = 0.3F;  ///< weight of any depth for a pixel that has none: colour decides
constexpr float kLeastColor =
    0.15F;  ///< of quite another colour: surfaces have textures, and depth says more
constexpr float kLeastWeight = 0.3F;  ///< fewer like-minded neighbours than this decide nothing
constexpr int kTapsPerRadius = 5;     ///< neighbours looked at: the result is smooth, so not each of them
constexpr double kReach = 3;          ///< sigmas behind which a weight is 0

/// exp(-x^2 / 2) for x in 0 .. kReach, by x^2.
class Falloff {
 public:
  Falloff() {
    for (std::size_t i = 0; i < table_.size(); ++i)
      table_[i] = static_cast<float>(std::exp(-0.5 * static_cast<double>(i) / kPerUnit));
  }
  /// x^2 = squared.
  float operator()(float squared) const {
    const auto i = static_cast<std::size_t>(squared * kPerUnit);
    return i < table_.size() ? table_[i] : 0;
  }

 private:
  static constexpr float kPerUnit = 64;
  std::array<float, static_cast<std::size_t>(kReach* kReach* kPerUnit)> table_{};
};

struct Tap {
  int dx, dy;
  float weight;
};

std::vector<Tap> taps_within(int radius_px) {
  std::vector<Tap> taps;
  const double sigma = 0.6 * radius_px;
  const int step_px = std::max(1, radius_px / kTapsPerRadius);
  for (int dy = -radius_px; dy <= radius_px; dy += step_px)
    for (int dx = -radius_px; dx <= radius_px; dx += step_px)
      if (dx * dx + dy * dy <= radius_px * radius_px)
        taps.push_back({dx, dy, static_cast<float>(std::exp(-0.5 * (dx * dx + dy * dy) / (sigma * sigma)))});
  return taps;
}

/// Twice the noise of a structured-light sensor (0.0012 z^2) and some for slanted surfaces, in depth units.
float depth_sigma(float depth, double depth_scale) {
  const double z_m = std::max(1.0, depth / depth_scale);
  return static_cast<float>((0.02 + 0.012 * z_m * z_m) * depth_scale);
}

/// Pixels whose side of the outline is not certain.
cv::Mat band_around(const cv::Mat& share, int radius_px) {
  const cv::Mat inside = share > 0.5, square = cv::Mat::ones(2 * radius_px + 1, 2 * radius_px + 1, CV_8U);
  cv::Mat grown, shrunk;
  cv::dilate(inside, grown, square);
  cv::erode(inside, shrunk, square);
  return grown & ~shrunk;
}

float mean_of_like(const cv::Mat& share, const cv::Mat& depth, const cv::Mat& color, int x, int y,
                   const std::vector<Tap>& taps, double depth_scale) {
  static const Falloff falloff;
  const float depth_here = depth.at<std::uint16_t>(y, x);
  const cv::Vec3b color_here = color.at<cv::Vec3b>(y, x);
  const float per_sigma = 1 / depth_sigma(depth_here, depth_scale);
  constexpr float kPerColor = static_cast<float>(1 / (kColorSigma * kColorSigma));
  float sum = 0, weights = 0;
  for (const Tap& tap : taps) {
    const int tx = std::clamp(x + tap.dx, 0, share.cols - 1), ty = std::clamp(y + tap.dy, 0, share.rows - 1);
    float weight = kWithoutDepth;
    if (depth_here > 0) {
      const float there = depth.at<std::uint16_t>(ty, tx), apart = (there - depth_here) * per_sigma;
      weight = there > 0 ? falloff(apart * apart) : 0;
    }
    if (weight == 0) continue;
    const cv::Vec3b color_there = color.at<cv::Vec3b>(ty, tx);
    float squared = 0;
    for (int c = 0; c < 3; ++c) {
      const float apart = static_cast<float>(color_there[c]) - static_cast<float>(color_here[c]);
      squared += apart * apart;
    }
    weight *= tap.weight * (kLeastColor + (1 - kLeastColor) * falloff(squared * kPerColor));
    sum += weight * share.at<float>(ty, tx);
    weights += weight;
  }
  return weights > kLeastWeight ? sum / weights : share.at<float>(y, x);
}

}  // namespace

void snap(SoftMask& mask, const cv::Mat& depth, const cv::Mat& color, double depth_scale,
          const SnapParameters& parameters) {
  if (parameters.radius_px <= 0) return;
  const cv::Mat depth_here = depth(mask.where);
  cv::Mat color_here;
  cv::GaussianBlur(color(mask.where), color_here, {}, 1);
  const auto taps = taps_within(parameters.radius_px);
  for (int round = 0; round < parameters.rounds; ++round) {
    const cv::Mat band = band_around(mask.share, parameters.radius_px);
    cv::Mat next = mask.share.clone();
    for (int y = 0; y < band.rows; ++y)
      for (int x = 0; x < band.cols; ++x)
        if (band.at<std::uint8_t>(y, x))
          next.at<float>(y, x) = mean_of_like(mask.share, depth_here, color_here, x, y, taps, depth_scale);
    mask.share = next;
  }
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
