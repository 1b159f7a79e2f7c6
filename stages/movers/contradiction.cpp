#include "stages/movers/contradiction.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/scene/frame.hpp"
#include "pipeline/scene/nearest_pixel.hpp"

namespace sediment::movers {
namespace {

constexpr int kMostVotes = 255;

/// Whether a pixel lies at a step of the depth: sensors show there what is nowhere.
bool is_edge(const cv::Mat& depth, int x, int y, double tolerance_units) {
  const int here = depth.at<std::uint16_t>(y, x);
  for (int dy = -kStep_px; dy <= kStep_px; dy += kStep_px)
    for (int dx = -kStep_px; dx <= kStep_px; dx += kStep_px) {
      const int u = std::clamp(x + dx, 0, depth.cols - 1), v = std::clamp(y + dy, 0, depth.rows - 1);
      const int there = depth.at<std::uint16_t>(v, u);
      if (there == 0 || std::abs(there - here) > tolerance_units) return true;
    }
  return false;
}

enum class Says { nothing, through, beyond, hit };

/// The references on one side in time that say something of a pixel.
struct Side {
  int told = 0, hits = 0;
  /// A thing that glides shows itself where it was a moment ago, too: one hit does not do.
  bool shows() const { return 3 * hits > told; }
};

/// One reference as seen from one view.
struct Pair {
  const Reference& reference;
  const Reference::Window& window;
  Pose there_from_here;
  double slack_m;
};

/// Those of which something can be said: slow enough for one of the windows.
std::vector<Pair> pairs_of(const View& view, std::span<const Reference* const> references,
                           const ContradictionParameters& parameters) {
  std::vector<Pair> pairs;
  for (const Reference* reference : references) {
    const double turned_rad = parameters.lag_s * (view.speed.rad_s + reference->speed.rad_s),
                 moved_m = parameters.lag_s * (view.speed.m_s + reference->speed.m_s);
    for (std::size_t w = 0; w < kReaches.size(); ++w)
      if (parameters.slack_rad + turned_rad <= 1.5 * kReaches[w] * parameters.slack_rad) {
        pairs.push_back({*reference, reference->windows[w],
                         reference->camera_from_world * view.world_from_camera,
                         parameters.slack_m + moved_m});
        break;
      }
  }
  return pairs;
}

/// What a pair says of a point of the view's camera frame.
Says judge(const Pair& pair, const Camera& camera, const Vec3& point,
           const ContradictionParameters& parameters) {
  const Vec3 p = pair.there_from_here * point;
  if (!(p.z >= parameters.min_depth_m && p.z <= parameters.max_depth_m)) return Says::nothing;
  const Pixel image = camera.project(p);
  if (!(image.u > -0.5 && image.v > -0.5 && image.u < camera.width - 0.5 && image.v < camera.height - 0.5))
    return Says::nothing;
  const int u = nearest_pixel(image.u), v = nearest_pixel(image.v);
  const auto tolerance_m = [&](double there_m) {
    return pair.slack_m +
           parameters.sigmas * parameters.noise * std::hypot(point.z * point.z, there_m * there_m);
  };
  const auto depth_m = [&](const cv::Mat& depth) {
    return depth.at<std::uint16_t>(v, u) / camera.depth_scale;
  };
  const double nearest_m = depth_m(pair.window.nearest);
  if (nearest_m > p.z + tolerance_m(nearest_m)) return Says::through;
  // Where the nearest is not known the pixel itself decides.
  const double before_m = nearest_m > 0 ? nearest_m : depth_m(pair.reference.depth);
  const double tolerance = tolerance_m(p.z);
  const bool around =
      before_m > 0 && before_m <= p.z + tolerance && depth_m(pair.window.farthest) >= p.z - tolerance;
  if (around) return Says::hit;
  return depth_m(pair.reference.depth) > p.z + tolerance ? Says::beyond : Says::nothing;
}

}  // namespace

Reference reference_of(const View& view, const Camera& camera, const ContradictionParameters& parameters) {
  Reference reference{view.stamp_s, view.world_from_camera.inverse(), view.speed, view.depth, {}};
  cv::Mat still = view.depth.clone();
  if (!view.dynamic.empty()) still.setTo(0, view.dynamic != kStatic);
  for (std::size_t w = 0; w < kReaches.size(); ++w) {
    const int reach =
        std::max(1, static_cast<int>(std::lround(kReaches[w] * parameters.slack_rad * camera.fx)));
    const cv::Mat window = cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8UC1);
    cv::dilate(still, reference.windows[w].farthest, window);
    cv::erode(view.depth, reference.windows[w].nearest, window, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  }
  return reference;
}

Verdicts verdicts_of(const View& view, std::span<const Reference* const> references, const Camera& camera,
                     const std::vector<Ray>& rays, const ContradictionParameters& parameters) {
  const int columns = view.depth.cols / kStep_px, rows = view.depth.rows / kStep_px;
  Verdicts verdicts{
      cv::Mat(rows, columns, CV_8UC1, cv::Scalar(0)), cv::Mat(rows, columns, CV_8UC1, cv::Scalar(0)),
      cv::Mat(rows, columns, CV_8UC1, cv::Scalar(0)), cv::Mat(rows, columns, CV_8UC1, cv::Scalar(255))};
  const std::vector<Pair> pairs = pairs_of(view, references, parameters);
  const auto count = [](std::uint8_t& votes) { votes += votes < kMostVotes ? 1 : 0; };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const cv::Point pixel = pixel_of({column, row});
      const int x = pixel.x, y = pixel.y;
      const double z = view.depth.at<std::uint16_t>(y, x) / camera.depth_scale;
      if (!(z >= parameters.min_depth_m && z <= parameters.max_depth_m)) continue;
      const double step_m = 0.03 + 0.03 * z;
      if (is_edge(view.depth, x, y, step_m * camera.depth_scale)) continue;
      const Ray& ray = rays[static_cast<std::size_t>(y) * camera.width + x];
      const Vec3 point{ray.x * z, ray.y * z, z};
      Side before, after;
      for (const Pair& pair : pairs) {
        const Says says = judge(pair, camera, point, parameters);
        if (says == Says::nothing) continue;
        Side& side = pair.reference.stamp_s < view.stamp_s ? before : after;
        ++side.told;
        side.hits += says == Says::hit;
        if (says == Says::through) count(verdicts.through.at<std::uint8_t>(row, column));
        if (says == Says::beyond) count(verdicts.beyond.at<std::uint8_t>(row, column));
        if (says == Says::hit) count(verdicts.hits.at<std::uint8_t>(row, column));
      }
      verdicts.lasting.at<std::uint8_t>(row, column) = before.shows() && after.shows() ? 255 : 0;
    }
  return verdicts;
}

}  // namespace sediment::movers
