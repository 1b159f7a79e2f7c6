#include "stages/movers/contradiction.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

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

enum class Says { nothing, through, hit };

/// What one reference says of a point at `depth_m` in the view, at `p` in the reference's camera frame.
Says judge(const Reference& reference, const Camera& camera, const Vec3& p, double depth_m,
           const ContradictionParameters& parameters) {
  if (!(p.z >= parameters.min_depth_m && p.z <= parameters.max_depth_m)) return Says::nothing;
  const Pixel image = camera.project(p);
  if (!(image.u > -0.5 && image.v > -0.5 && image.u < camera.width - 0.5 && image.v < camera.height - 0.5))
    return Says::nothing;
  const int u = static_cast<int>(std::lround(image.u)), v = static_cast<int>(std::lround(image.v));
  const auto tolerance_m = [&](double there_m) {
    const double own = depth_m * depth_m, other = there_m * there_m;
    return parameters.slack_m + parameters.sigmas * parameters.noise * std::sqrt(own * own + other * other);
  };
  const double nearest_m = reference.nearest.at<std::uint16_t>(v, u) / camera.depth_scale;
  if (nearest_m > p.z + tolerance_m(nearest_m)) return Says::through;
  const double farthest_m = reference.farthest.at<std::uint16_t>(v, u) / camera.depth_scale;
  const double tolerance = tolerance_m(p.z);
  // Where the nearest is not known the pixel itself decides.
  const double before_m =
      nearest_m > 0 ? nearest_m : reference.depth.at<std::uint16_t>(v, u) / camera.depth_scale;
  return before_m > 0 && before_m <= p.z + tolerance && farthest_m >= p.z - tolerance ? Says::hit
                                                                                      : Says::nothing;
}

}  // namespace

Reference reference_of(const View& view, const Camera& camera, const ContradictionParameters& parameters) {
  const int reach = std::max(1, static_cast<int>(std::lround(parameters.slack_rad * camera.fx)));
  const cv::Mat window = cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8UC1);
  Reference reference{view.world_from_camera.inverse(), view.depth, {}, {}};
  cv::Mat still = view.depth.clone();
  if (!view.dynamic.empty()) still.setTo(0, view.dynamic != 0);
  cv::dilate(still, reference.farthest, window);
  cv::erode(view.depth, reference.nearest, window, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  return reference;
}

Verdicts verdicts_of(const View& view, std::span<const Reference* const> references, const Camera& camera,
                     const std::vector<Ray>& rays, const ContradictionParameters& parameters) {
  const int columns = view.depth.cols / kStep_px, rows = view.depth.rows / kStep_px;
  Verdicts verdicts{cv::Mat(rows, columns, CV_8UC1, cv::Scalar(0)),
                    cv::Mat(rows, columns, CV_8UC1, cv::Scalar(0))};
  std::vector<Pose> there_from_here;
  for (const Reference* reference : references)
    there_from_here.push_back(reference->camera_from_world * view.world_from_camera);
  const auto count = [](std::uint8_t& votes) { votes += votes < kMostVotes ? 1 : 0; };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int x = column * kStep_px + kStep_px / 2, y = row * kStep_px + kStep_px / 2;
      const double z = view.depth.at<std::uint16_t>(y, x) / camera.depth_scale;
      if (!(z >= parameters.min_depth_m && z <= parameters.max_depth_m)) continue;
      const double step_m = 0.03 + 0.03 * z;
      if (is_edge(view.depth, x, y, step_m * camera.depth_scale)) continue;
      const Ray& ray = rays[static_cast<std::size_t>(y) * camera.width + x];
      const Vec3 point{ray.x * z, ray.y * z, z};
      for (std::size_t i = 0; i < references.size(); ++i) {
        const Says says = judge(*references[i], camera, there_from_here[i] * point, z, parameters);
        if (says == Says::through) count(verdicts.through.at<std::uint8_t>(row, column));
        if (says == Says::hit) count(verdicts.hits.at<std::uint8_t>(row, column));
      }
    }
  return verdicts;
}

}  // namespace sediment::movers
