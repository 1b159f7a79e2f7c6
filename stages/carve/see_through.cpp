#include "stages/carve/see_through.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "pipeline/scene/frame.hpp"
#include "pipeline/scene/nearest_pixel.hpp"

namespace sediment::carve {
namespace {

/// Smallest and largest depth of the window around each pixel; the smallest is 0 if one of them has none.
struct WindowDepths {
  cv::Mat nearest, farthest;
};

WindowDepths window_depths(const cv::Mat& depth, int window_px) {
  const int side = 2 * window_px + 1;
  const cv::Mat window = cv::Mat::ones(side, side, CV_8UC1);
  WindowDepths depths;
  cv::erode(depth, depths.nearest, window, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  cv::dilate(depth, depths.farthest, window, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  return depths;
}

/// A view ready to be asked.
struct Look {
  const Camera& camera;
  const DepthView& view;
  const Parameters& parameters;
  WindowDepths around;
  Pose world_from_camera;
  bool bent;  ///< the camera's lens distorts

  double tolerance_m(double depth_m) const {
    return parameters.slack_m + parameters.sigmas * parameters.noise * depth_m * depth_m;
  }

  bool agree(double measured_m, double depth_m) const {
    return measured_m > 0 && std::abs(measured_m - depth_m) <= tolerance_m(measured_m);
  }

  std::uint8_t dynamic_at(int u, int v) const {
    return view.dynamic.empty() ? std::uint8_t{kStatic} : view.dynamic.at<std::uint8_t>(v, u);
  }

  /// Units of depth outside of which nothing agrees with `depth_m`: the roots m of |m - depth| =
  /// tolerance(m), and one unit more, as agree() decides.
  std::pair<int, int> units_near(double depth_m) const {
    const double k = 4 * parameters.sigmas * parameters.noise;
    const double near_m = std::max(0.0, depth_m - parameters.slack_m), far_m = depth_m + parameters.slack_m;
    const double least_m = 2 * near_m / (1 + std::sqrt(1 + k * near_m));
    const double root = std::sqrt(std::max(0.0, 1 - k * far_m));
    double most = 2 * far_m / (1 + root) * camera.depth_scale;
    // Beyond its other root the tolerance is larger than any depth.
    if (2 * (1 + root) / k * camera.depth_scale <= 65535) most = 65535;
    return {static_cast<int>(least_m * camera.depth_scale) - 1,
            static_cast<int>(std::min(most, 65535.0)) + 1};
  }

  /// Judged by the measured depth, as seeing through is: a depth is one or the other or in front.
  bool sees(int u, int v, double depth_m) const {
    const auto [least, most] = units_near(depth_m);
    if (around.farthest.at<std::uint16_t>(v, u) < least) return false;  // hidden: most that are not seen
    const int reach = parameters.window_px;
    const int left = std::max(0, u - reach), right = std::min(view.depth.cols - 1, u + reach);
    for (int y = std::max(0, v - reach); y <= std::min(view.depth.rows - 1, v + reach); ++y) {
      const auto* row = view.depth.ptr<std::uint16_t>(y);
      for (int x = left; x <= right; ++x)
        if (row[x] >= least && row[x] <= most && agree(row[x] / camera.depth_scale, depth_m) &&
            dynamic_at(x, y) == kStatic)
          return true;
    }
    return false;
  }

  void vote(const LabelledPoint& point, Votes& votes) const {
    const Vec3 p = view.camera_from_world * Vec3{point.x, point.y, point.z};
    if (!(p.z >= parameters.min_depth_m && p.z <= parameters.max_depth_m)) return;
    const Pixel image = bent ? camera.project(p) : camera.project_straight(p);
    if (!(image.u > -0.5 && image.v > -0.5 && image.u < view.depth.cols - 0.5 &&
          image.v < view.depth.rows - 0.5))
      return;
    const int u = nearest_pixel(image.u), v = nearest_pixel(image.v);
    const double nearest_m = around.nearest.at<std::uint16_t>(v, u) / camera.depth_scale;
    // The noise of the depth that is measured, which is the larger one.
    if (nearest_m > p.z + tolerance_m(nearest_m)) {
      count(votes.through);
      return;
    }
    const double measured_m = view.depth.at<std::uint16_t>(v, u) / camera.depth_scale;
    const bool agrees = agree(measured_m, p.z);
    const std::uint8_t dynamic = agrees ? dynamic_at(u, v) : std::uint8_t{kStatic};
    if ((agrees && dynamic == kStatic) || sees(u, v, p.z))
      count(votes.hits);
    else if (measured_m > p.z + tolerance_m(measured_m))
      count(votes.behind);
    if (!agrees) return;
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

void add_votes(const PointBlocks& cloud, const Camera& camera, const DepthView& view,
               const Parameters& parameters, std::vector<Votes>& votes) {
  const Look look{camera,
                  view,
                  parameters,
                  window_depths(view.depth, parameters.window_px),
                  view.camera_from_world.inverse(),
                  camera.has_distortion()};
  const Frustum frustum = frustum_of(camera, parameters.min_depth_m, parameters.max_depth_m);
  tbb::parallel_for(std::size_t{0}, cloud.blocks.size(), [&](std::size_t b) {
    const Block& block = cloud.blocks[b];
    if (!block.may_be_in(frustum, view.camera_from_world)) return;
    for (std::size_t i = block.begin; i < block.end; ++i) look.vote(cloud.points[i], votes[i]);
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
