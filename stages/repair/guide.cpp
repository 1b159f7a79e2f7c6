#include "stages/repair/guide.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "pipeline/scene/vector_clones.hpp"

namespace sediment::repair {
namespace {

constexpr float kColorSigma = 18;      ///< grey levels, over the three channels together
constexpr float kWithoutDepth = 0.3F;  ///< weight of any depth for a pixel that has none: colour decides
constexpr float kLeastColor =
    0.15F;  ///< of quite another colour: surfaces have textures, and depth says more
constexpr float kLeastWeight = 0.3F;   ///< fewer like-minded neighbours than this decide nothing
constexpr int kTapsPerRadius = 5;      ///< neighbours looked at: the result is smooth, so not each of them
constexpr float kPerReach = 1.0F / 9;  ///< weights end at 3 sigmas
constexpr float kNowhere = 1e9F;       ///< depth of what has none, as others see it
constexpr int kLanes = 16;

// GCC splits it where the processor's own vectors are shorter.
typedef float Lanes __attribute__((vector_size(4 * kLanes)));
typedef float UnalignedLanes __attribute__((vector_size(4 * kLanes), aligned(4), may_alias));

std::vector<Guide::Tap> taps_within(int radius_px) {
  std::vector<Guide::Tap> taps;
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

/// The planes at some pixel, and a tap's share of it.
struct Planes {
  const float *depth, *per_sigma, *certainty, *color[3], *share;
  std::ptrdiff_t stride, share_stride;
};

/// Means at kLanes pixels of a row. Both weights fall off as (1 - x^2 / 9)^4, x in sigmas: near to a
/// Gaussian.
SEDIMENT_CLONES void mean_of_lanes(const Planes& at, const std::vector<Guide::Tap>& taps, float* means) {
  const auto lanes = [](const float* from) -> const UnalignedLanes* {
    return reinterpret_cast<const UnalignedLanes*>(from);
  };
  constexpr float kPerColor = kPerReach / (kColorSigma * kColorSigma);
  const Lanes depth = *lanes(at.depth), per_sigma = *lanes(at.per_sigma), certainty = *lanes(at.certainty);
  const Lanes blue = *lanes(at.color[0]), green = *lanes(at.color[1]), red = *lanes(at.color[2]);
  const Lanes zero{};
  Lanes sum{}, weights{};
  for (const Guide::Tap& tap : taps) {
    const std::ptrdiff_t there = tap.dy * at.stride + tap.dx;
    const Lanes apart = (*lanes(at.depth + there) - depth) * per_sigma;
    const Lanes b = *lanes(at.color[0] + there) - blue, g = *lanes(at.color[1] + there) - green,
                r = *lanes(at.color[2] + there) - red;
    Lanes like_depth = 1 - kPerReach * (apart * apart);
    Lanes like_color = 1 - kPerColor * (b * b + g * g + r * r);
    like_depth = like_depth > zero ? like_depth : zero;
    like_color = like_color > zero ? like_color : zero;
    like_depth *= like_depth;
    like_depth *= like_depth;
    like_color *= like_color;
    like_color *= like_color;
    const Lanes weight = tap.weight * certainty * like_depth * (kLeastColor + (1 - kLeastColor) * like_color);
    sum += weight * *lanes(at.share + tap.dy * at.share_stride + tap.dx);
    weights += weight;
  }
  const Lanes own = *lanes(at.share), mean = sum / weights;
  const Lanes decided = weights > kLeastWeight ? mean : own;
  std::memcpy(means, &decided, sizeof decided);
}

cv::Mat with_border(const cv::Mat& plane, int border_px) {
  cv::Mat bordered;
  // Rows are read kLanes at a time: so much more to the right.
  cv::copyMakeBorder(plane, bordered, border_px, border_px, border_px, border_px + kLanes,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  return bordered;
}

}  // namespace

Guide guide_of(const cv::Mat& depth, const cv::Mat& color, double depth_scale, int radius_px) {
  Guide guide{radius_px,
              radius_px,
              cv::Mat(depth.size(), CV_32FC1),
              cv::Mat(depth.size(), CV_32FC1),
              cv::Mat(depth.size(), CV_32FC1),
              {},
              taps_within(radius_px)};
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x) {
      const auto units = depth.at<std::uint16_t>(y, x);
      guide.depth.at<float>(y, x) = units > 0 ? units : kNowhere;
      guide.per_sigma.at<float>(y, x) = units > 0 ? 1 / depth_sigma(units, depth_scale) : 0;
      guide.certainty.at<float>(y, x) = units > 0 ? 1 : kWithoutDepth;
    }
  cv::Mat smooth, planes[3];
  cv::GaussianBlur(color, smooth, {}, 1);
  cv::split(smooth, planes);
  for (int c = 0; c < 3; ++c) {
    planes[c].convertTo(guide.color[c], CV_32F);
    guide.color[c] = with_border(guide.color[c], radius_px);
  }
  for (cv::Mat* plane : {&guide.depth, &guide.per_sigma, &guide.certainty})
    *plane = with_border(*plane, radius_px);
  return guide;
}

cv::Mat mean_of_like(const cv::Mat& share, const cv::Rect& where, const cv::Mat& band, const Guide& guide) {
  cv::Mat means = share.clone();
  const cv::Mat shares = with_border(share, guide.border_px);
  const int border = guide.border_px;
  float some[kLanes];
  for (int y = 0; y < band.rows; ++y) {
    const auto* open = band.ptr<std::uint8_t>(y);
    for (int x = 0; x < band.cols; ++x) {
      if (!open[x]) continue;
      const int row = y + where.y + border, column = x + where.x + border;
      const auto at = [&](const cv::Mat& plane) { return plane.ptr<float>(row) + column; };
      mean_of_lanes({at(guide.depth),
                     at(guide.per_sigma),
                     at(guide.certainty),
                     {at(guide.color[0]), at(guide.color[1]), at(guide.color[2])},
                     shares.ptr<float>(y + border) + x + border,
                     static_cast<std::ptrdiff_t>(guide.depth.step1()),
                     static_cast<std::ptrdiff_t>(shares.step1())},
                    guide.taps, some);
      const int end = std::min(x + kLanes, band.cols);
      for (int i = 0; x < end; ++x, ++i)
        if (open[x]) means.at<float>(y, x) = some[i];
      --x;
    }
  }
  return means;
}

}  // namespace sediment::repair
