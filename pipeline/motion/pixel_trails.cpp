#include "pipeline/motion/pixel_trails.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sediment {
namespace {

constexpr float kOneWayTrust = 0.25F;
constexpr std::size_t kGrain = 1 << 13;  ///< trails that are worth a task of their own

/// One step of trails first .. last - 1: no trail knows of another.
struct Step {
  PixelTrails& trails;
  const FlowField &flow, &reverse;
  const cv::Mat& depth;
  float absolute, relative;

  void operator()(std::size_t first, std::size_t last) const {
    constexpr std::size_t kMost = 512;
    std::array<float, kMost> du, dv, back_u, back_v;
    for (std::size_t begin = first; begin < last; begin += kMost) {
      const std::size_t count = std::min(kMost, last - begin);
      float *u = trails.u.data() + begin, *v = trails.v.data() + begin;
      flow.at_each(u, v, count, du.data(), dv.data());
      for (std::size_t i = 0; i < count; ++i) {
        u[i] += du[i];
        v[i] += dv[i];
      }
      reverse.at_each(u, v, count, back_u.data(), back_v.data());
      for (std::size_t i = 0; i < count; ++i)
        if (trails.valid[begin + i]) check(begin + i, {du[i], dv[i]}, {back_u[i], back_v[i]});
    }
  }

  /// Trail i, which was valid until it moved.
  void check(std::size_t i, cv::Point2f moved, cv::Point2f back) const {
    const float last_u = static_cast<float>(depth.cols - 1), last_v = static_cast<float>(depth.rows - 1);
    const float u = trails.u[i], v = trails.v[i];
    if (!(u >= 0 && u <= last_u && v >= 0 && v <= last_v)) {
      trails.valid[i] = 0;
      return;
    }
    if (!is_mutual(moved, back)) trails.trust[i] *= kOneWayTrust;
    const auto seen = trails.nearest<std::uint16_t>(depth, i);
    if (seen == 0) return;
    const float before = trails.depth[i], change = std::abs(static_cast<float>(seen) - before);
    if (before != 0 && change > absolute + relative * before) trails.valid[i] = 0;
    trails.depth[i] = seen;
  }
};

}  // namespace

PixelTrails start_trails(const cv::Mat& depth, int step_px) {
  PixelTrails trails{
      step_px, (depth.cols + step_px - 1) / step_px, (depth.rows + step_px - 1) / step_px, {}, {}, {}, {},
      {}};
  const std::size_t size = static_cast<std::size_t>(trails.columns) * trails.rows;
  trails.u.reserve(size);
  trails.v.reserve(size);
  trails.depth.reserve(size);
  for (int row = 0; row < trails.rows; ++row)
    for (int column = 0; column < trails.columns; ++column) {
      const int x = std::min(column * step_px + step_px / 2, depth.cols - 1);
      const int y = std::min(row * step_px + step_px / 2, depth.rows - 1);
      trails.u.push_back(static_cast<float>(x));
      trails.v.push_back(static_cast<float>(y));
      trails.depth.push_back(depth.at<std::uint16_t>(y, x));
    }
  trails.valid.assign(size, 1);
  trails.trust.assign(size, 1);
  return trails;
}

void follow(PixelTrails& trails, const FlowField& flow, const FlowField& reverse, const cv::Mat& depth,
            double depth_scale, const DepthTolerance& tolerance) {
  const Step step{trails,
                  flow,
                  reverse,
                  depth,
                  static_cast<float>(tolerance.absolute_m * depth_scale),
                  static_cast<float>(tolerance.relative)};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, trails.size(), kGrain),
                    [&](const auto& range) { step(range.begin(), range.end()); });
}

}  // namespace sediment
