#include "stages/carve/see_through.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "pipeline/scene/frame.hpp"

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
  Pose world_from_camera;

  double tolerance_m(double depth_m) const {
    return parameters.slack_m + parameters.sigmas * parameters.noise * depth_m * depth_m;
  }

  bool agree(double measured_m, double depth_m) const {
    return measured_m > 0 && std::abs(measured_m - depth_m) <= tolerance_m(measured_m);
  }

  std::uint8_t dynamic_at(int u, int v) const {
    return view.dynamic.empty() ? std::uint8_t{kStatic} : view.dynamic.at<std::uint8_t>(v, u);
  }

  /// Judged by the measured depth, as seeing through is: a depth is one or the other or in front.
  bool sees(int u, int v, double depth_m) const {
    const int reach = parameters.window_px;
    for (int y = std::max(0, v - reach); y <= std::min(view.depth.rows - 1, v + reach); ++y)
      for (int x = std::max(0, u - reach); x <= std::min(view.depth.cols - 1, u + reach); ++x) {
        const double measured_m = view.depth.at<std::uint16_t>(y, x) / camera.depth_scale;
        if (agree(measured_m, depth_m) && dynamic_at(x, y) == kStatic) return true;
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
    const double nearest_m = nearest.at<std::uint16_t>(v, u) / camera.depth_scale;
    // The noise of the depth that is measured, which is the larger one.
    if (nearest_m > p.z + tolerance_m(nearest_m)) {
      count(votes.through);
      return;
    }
    const double measured_m = view.depth.at<std::uint16_t>(v, u) / camera.depth_scale;
    if (sees(u, v, p.z))
      count(votes.hits);
    else if (measured_m > p.z + tolerance_m(measured_m))
      count(votes.behind);
    if (!agree(measured_m, p.z)) return;
    const std::uint8_t dynamic = dynamic_at(u, v);
    if (dynamic == kPriorDynamic) count(votes.person);
    if (dynamic != kStatic) return;
    count(votes.shown);
    if (parameters.settle) settle(p, measured_m, votes);
  }

  static void count(std::uint16_t& votes) {
    votes += votes < std::numeric_limits<std::uint16_t>::max() ? 1 : 0;
  }

  void settle(Vec3 p, double measured_m, Votes& votes) const {
    // No sensor is better than a millimetre.
    const double deviation_m = std::max(0.001, parameters.noise * measured_m * measured_m);
    const double weight = 1 / (deviation_m * deviation_m);
    const Vec3 way = world_from_camera.rotate((measured_m / p.z - 1) * p);
    votes.weight += static_cast<float>(weight);
    votes.x += static_cast<float>(weight * way.x);
    votes.y += static_cast<float>(weight * way.y);
    votes.z += static_cast<float>(weight * way.z);
  }
};

}  // namespace

void add_votes(const LabelledCloud& cloud, const Camera& camera, const DepthView& view,
               const Parameters& parameters, std::vector<Votes>& votes) {
  const Look look{camera, view, parameters, nearest_depths(view.depth, parameters.window_px),
                  view.camera_from_world.inverse()};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 1 << 13), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) look.vote(cloud[i], votes[i]);
  });
}

bool is_carved(const Votes& votes, const Parameters& parameters) {
  const int told = votes.through + votes.hits;
  if (votes.through >= parameters.min_views && votes.through > parameters.min_share * told) return true;
  const int behind = votes.through + votes.behind;
  if (behind >= parameters.min_views && votes.hits < parameters.min_confirmed * (votes.hits + behind))
    return true;
  return votes.person >= parameters.min_views &&
         votes.person > parameters.max_person_share * (votes.person + votes.shown);
}

LabelledPoint settled(LabelledPoint point, const Votes& votes, const Parameters& parameters) {
  if (votes.shown < parameters.min_views) return point;
  point.x += votes.x / votes.weight;
  point.y += votes.y / votes.weight;
  point.z += votes.z / votes.weight;
  return point;
}

}  // namespace sediment::carve
