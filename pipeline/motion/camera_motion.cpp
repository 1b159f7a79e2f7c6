#include "pipeline/motion/camera_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace sediment {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kFewest = 30;
constexpr double kSmallestShare = 1.0 / 3;
constexpr int kIterations = 20;
constexpr double kLeastScale_px = 0.2;  ///< the flow is not more exact than this
constexpr double kBehind_px = 1e9;      ///< stands for the distance of a point behind the camera
constexpr double kConverged = 1e-7;     ///< metres and radians

/// Where a point is seen less where it should be, in units of the image plane at distance 1.
Eigen::Vector2d error_of(const SeenPoint& seen, const Vec3& point) {
  return {seen.ray.u - point.x / point.z, seen.ray.v - point.y / point.z};
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Derivative of the image of a point by translation and rotation of the camera frame.
Eigen::Matrix<double, 2, 6> jacobian(const Vec3& p) {
  const double iz = 1 / p.z, x = p.x * iz, y = p.y * iz;
  Eigen::Matrix<double, 2, 6> j;
  j << iz, 0, -x * iz, -x * y, 1 + x * x, -y,  //
      0, iz, -y * iz, -1 - y * y, x * y, x;
  return j;
}

Pose update(const Pose& pose, const Vector6& delta) {
  Pose change = rotation_from({delta[3], delta[4], delta[5]});
  change.translation = {delta[0], delta[1], delta[2]};
  return change * pose;
}

}  // namespace

std::optional<CameraMotion> camera_motion(std::span<const SeenPoint> points, double focal_px) {
  if (points.size() < kFewest) return std::nullopt;
  CameraMotion motion;
  std::vector<double> distances_px(points.size());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 point = motion.to_from * points[i].point_m;
      distances_px[i] = point.z > 0 ? focal_px * error_of(points[i], point).norm() : kBehind_px;
    }
    motion.median_error_px = median(distances_px);
    // 1.48 x the median is the standard deviation of a normal error; Tukey's biweight ends at 4.7 of these.
    const double reach_px = 4.7 * std::max(kLeastScale_px, 1.48 * motion.median_error_px);

    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    std::size_t inliers = 0;
    for (const SeenPoint& seen : points) {
      const Vec3 point = motion.to_from * seen.point_m;
      if (point.z <= 0) continue;
      const Eigen::Vector2d error = error_of(seen, point);
      const double ratio = focal_px * error.norm() / reach_px;
      if (ratio >= 1) continue;
      const double weight = (1 - ratio * ratio) * (1 - ratio * ratio);
      const auto j = jacobian(point);
      normal += weight * j.transpose() * j;
      right += weight * j.transpose() * error;
      ++inliers;
    }
    motion.inlier_share = static_cast<double>(inliers) / static_cast<double>(points.size());
    if (inliers < kFewest || motion.inlier_share < kSmallestShare) return std::nullopt;
    const Vector6 delta = normal.ldlt().solve(right);
    if (!delta.allFinite()) return std::nullopt;
    motion.to_from = update(motion.to_from, delta);
    if (delta.norm() < kConverged) break;
  }
  return motion;
}

}  // namespace sediment
