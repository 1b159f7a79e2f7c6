#include "pipeline/motion/pixel_trails.hpp"

#include <cmath>

namespace sediment {
namespace {

constexpr float kOneWayTrust = 0.25F;

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
  const float last_u = static_cast<float>(depth.cols - 1), last_v = static_cast<float>(depth.rows - 1);
  const float absolute = static_cast<float>(tolerance.absolute_m * depth_scale);
  const float relative = static_cast<float>(tolerance.relative);
  for (std::size_t i = 0; i < trails.size(); ++i) {
    if (!trails.valid[i]) continue;
    const cv::Point2f moved = flow.at(trails.u[i], trails.v[i]);
    trails.u[i] += moved.x;
    trails.v[i] += moved.y;
    if (!(trails.u[i] >= 0 && trails.u[i] <= last_u && trails.v[i] >= 0 && trails.v[i] <= last_v)) {
      trails.valid[i] = 0;
      continue;
    }
    if (!is_mutual(moved, reverse.at(trails.u[i], trails.v[i]))) trails.trust[i] *= kOneWayTrust;
    const auto seen = trails.nearest<std::uint16_t>(depth, i);
    if (seen == 0) continue;
    const float before = trails.depth[i], change = std::abs(static_cast<float>(seen) - before);
    if (before != 0 && change > absolute + relative * before) trails.valid[i] = 0;
    trails.depth[i] = seen;
  }
}

}  // namespace sediment
