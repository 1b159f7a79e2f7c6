// How outlines snap, the dearest part of repair: the joint bilateral filter in vector code against the same
// sums pixel by pixel with exponentials from a table. One core, the detections of synthetic frames, printed
// as Markdown.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "benchmarks/timing.hpp"
#include "stages/repair/snap.hpp"
#include "tests/synthetic/synthetic_sequence.hpp"

using namespace sediment;
using benchmark::seconds_of;
using namespace sediment::repair;

namespace {

constexpr int kRadius_px = 14, kMargin_px = 16;

/// Gaussians of x^2 = squared up to three sigmas, from a table.
float falloff(float squared) {
  static const std::vector<float> table = [] {
    std::vector<float> values;
    for (int i = 0; i < 9 * 64; ++i) values.push_back(static_cast<float>(std::exp(-0.5 * i / 64)));
    return values;
  }();
  const auto i = static_cast<std::size_t>(squared * 64);
  return i < table.size() ? table[i] : 0;
}

/// The mean at one pixel of the guide's planes; `share` has the guide's border around it.
float direct_mean(const Guide& guide, const cv::Mat& share, int u, int v, int x, int y) {
  float sum = 0, weights = 0;
  for (const Guide::Tap& tap : guide.taps) {
    const float apart = (guide.depth.at<float>(v + tap.dy, u + tap.dx) - guide.depth.at<float>(v, u)) *
                        guide.per_sigma.at<float>(v, u);
    float color = 0;
    for (const cv::Mat& plane : guide.color) {
      const float difference = plane.at<float>(v + tap.dy, u + tap.dx) - plane.at<float>(v, u);
      color += difference * difference;
    }
    const float weight = tap.weight * guide.certainty.at<float>(v, u) *
                         falloff(std::min(apart * apart, 1e3F)) *
                         (0.15F + 0.85F * falloff(std::min(color / (18 * 18), 1e3F)));
    sum += weight * share.at<float>(y + tap.dy, x + tap.dx);
    weights += weight;
  }
  return weights > 0.3F ? sum / weights : share.at<float>(y, x);
}

struct Case {
  Guide guide;
  std::vector<SoftMask> masks;
};

std::vector<Case> cases() {
  std::vector<Case> cases;
  const auto sequence =
      test::synthetic_sequence({.frames = 6, .width = 640, .height = 480, .degraded = true, .rate_hz = 4});
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const Frame& frame = sequence.frames[i];
    Case one{guide_of(frame.depth, frame.color, sequence.camera.depth_scale, kRadius_px), {}};
    for (const Instance& instance : sequence.degraded[i].instances) {
      const cv::Mat inside = sequence.degraded[i].ids == instance.id;
      const cv::Rect tight = cv::boundingRect(inside);
      const cv::Rect where = cv::Rect(tight.x - kMargin_px, tight.y - kMargin_px,
                                      tight.width + 2 * kMargin_px, tight.height + 2 * kMargin_px) &
                             cv::Rect({}, inside.size());
      SoftMask mask{0, 1, where, {}};
      inside(where).convertTo(mask.share, CV_32F, 1.0 / 255);
      one.masks.push_back(mask);
    }
    cases.push_back(std::move(one));
  }
  return cases;
}

}  // namespace

int main() {
  double vectors_s = 0, direct_s = 0, largest = 0;
  int masks = 0;
  for (const Case& one : cases())
    for (const SoftMask& mask : one.masks) {
      const cv::Mat band(mask.share.size(), CV_8UC1, cv::Scalar(255));
      cv::Mat fast, bordered, direct = mask.share.clone();
      vectors_s += seconds_of([&] { fast = mean_of_like(mask.share, mask.where, band, one.guide); });
      const int border = one.guide.border_px;
      cv::copyMakeBorder(mask.share, bordered, border, border, border, border, cv::BORDER_REPLICATE);
      direct_s += seconds_of([&] {
        for (int y = 0; y < direct.rows; ++y)
          for (int x = 0; x < direct.cols; ++x)
            direct.at<float>(y, x) = direct_mean(one.guide, bordered, x + mask.where.x + border,
                                                 y + mask.where.y + border, x + border, y + border);
      });
      largest = std::max(largest, cv::norm(fast, direct, cv::NORM_INF));
      ++masks;
    }
  std::printf(
      "| %d masks | ms |\n|---|---|\n| vector code | %.1f |\n| pixel by pixel | %.1f (%.1f times) |\n", masks,
      1e3 * vectors_s, 1e3 * direct_s, direct_s / vectors_s);
  std::printf("\nLargest difference of a mean, as the weights are near to Gaussians: %.3f\n", largest);
}
