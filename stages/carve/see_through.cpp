#include "stages/carve/see_through.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace sediment::carve {
namespace {

/// Smallest depth of the window around each pixel, 0 if one of them has none.
cv::Mat nearest_depths(const cv::Mat& depth, int window_px) {
  const int side = 2 * window_px + 1;
  cv::Mat nearest;
  cv::erode(depth, nearest, cv::Mat::ones(side, side, CV_8UC1), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  return nearest;
}

/// A view ready to be asked.
struct Look {
  const Camera& camera;
  const DepthView& view;
  const Parameters& parameters;
  cv::Mat nearest;

  double tolerance_m(double depth_m) const {
    return parameters.slack_m + parameters.sigmas * parameters.noise * depth_m * depth_m;
  }

  /// Judged by the measured depth, as seeing through is: a depth is one or the other or in front.
  bool sees(int u, int v, double depth_m) const {
    const int reach = parameters.window_px;
    for (int y = std::max(0, v - reach); y <= std::min(view.depth.rows - 1, v + reach); ++y)
      for (int x = std::max(0, u - reach); x <= std::min(view.depth.cols - 1, u + reach); ++x) {
        const double measured_m = view.depth.at<std::uint16_t>(y, x) / camera.depth_scale;
        if (measured_m > 0 && std::abs(measured_m - depth_m) <= tolerance_m(measured_m) &&
            (view.dynamic.empty() || view.dynamic.at<std::uint8_t>(y, x) == 0))
          return true;
      }
    return false;
  }

  void vote(const LabelledPoint& point, Votes& votes) const {
    const Vec3 p = view.camera_from_world * Vec3{point.x, point.y, point.z};
    if (!(p.z >= parameters.min_depth_m && p.z <= parameters.max_depth_m)) return;
    const Pixel image = camera.project(p);
    if (!(image.u > -0.5 && image.v > -0.5 && image.u < view.depth.cols - 0.5 &&
          image.v < view.depth.rows - 0.5))
      return;
    const int u = static_cast<int>(std::lround(image.u)), v = static_cast<int>(std::lround(image.v));
    const double behind_m = nearest.at<std::uint16_t>(v, u) / camera.depth_scale;
    // The noise of the depth that is measured, which is the larger one.
    const bool through = behind_m > p.z + tolerance_m(behind_m);
    constexpr std::uint16_t kMost = std::numeric_limits<std::uint16_t>::max();
    if (through)
      votes.through += votes.through < kMost ? 1 : 0;
    else if (sees(u, v, p.z))
      votes.hits += votes.hits < kMost ? 1 : 0;
  }
};

}  // namespace

void add_votes(const LabelledCloud& cloud, const Camera& camera, const DepthView& view,
               const Parameters& parameters, std::vector<Votes>& votes) {
  const Look look{camera, view, parameters, nearest_depths(view.depth, parameters.window_px)};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 1 << 13), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) look.vote(cloud[i], votes[i]);
  });
}

bool is_carved(const Votes& votes, const Parameters& parameters) {
  const int told = votes.through + votes.hits;
  return votes.through >= parameters.min_views && votes.through > parameters.min_share * told;
}

}  // namespace sediment::carve
