#include "stages/track/pose_estimation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "stages/track/bundle_links.hpp"
#include "stages/track/link_residual.hpp"

namespace sediment::track {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr int kRounds = 4, kStepsPerRound = 6;
constexpr double kLargestScale = 3;

Eigen::Matrix3d cross_of(const Vec3& v) {
  return (Eigen::Matrix3d() << 0, -v.z, v.y, v.z, 0, -v.x, -v.y, v.x, 0).finished();
}

// Derivatives of half the cost by a step as `updated` makes it.
struct Slope {
  Matrix6 information = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
};

void add_view(const AlignedView& view, const Pose& camera_from_world, double scale, Slope& slope) {
  const LinkResidual r = link_residual(view.camera_from_world, camera_from_world, view.frame_from_camera);
  const Eigen::Map<const RowMajor6> own(view.information.data());
  const Eigen::Map<const Vector6> error(r.error.data());
  Matrix6 jacobian = Eigen::Map<const RowMajor6>(r.by_to.data());
  const Vec3 t = camera_from_world.translation;  // a step here turns it as well: -[t]x
  jacobian.leftCols<3>() += jacobian.rightCols<3>() * cross_of({-t.x, -t.y, -t.z});
  const double weight = scale * huber_weight(error.dot(own * error), kChiSquare6);
  slope.information.noalias() += weight * jacobian.transpose() * own * jacobian;
  slope.gradient.noalias() += weight * jacobian.transpose() * (own * error);
}

Slope slope_at(const std::vector<Correspondence>& correspondences, const std::vector<char>& inlier,
               const Pinhole& pinhole, double huber_scale, std::span<const AlignedView> views,
               const Pose& camera_from_world) {
  Slope slope;
  // Correspondences are weighed as if the frame had no more noise than they promise: views are with them.
  for (const AlignedView& view : views) add_view(view, camera_from_world, huber_scale, slope);
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    if (!inlier[i]) continue;
    const Measurement& measurement = correspondences[i].measurement;
    const Vec3 p = camera_from_world * correspondences[i].point;
    if (p.z < kProjectable_m) continue;
    const auto r = residual_of(measurement, pinhole, p);
    const auto by_point = residual_by_point(measurement, pinhole, p);
    const double bound = huber_scale * chi_square_bound(measurement), chi_square = squared(r);
    const double weight = chi_square > bound ? std::sqrt(bound / chi_square) : 1.0;
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian.rightCols<3>() = Eigen::Map<const RowMajor3>(by_point.data());
    jacobian.leftCols<3>().noalias() = jacobian.rightCols<3>() * cross_of({-p.x, -p.y, -p.z});  // of exp(w) p
    slope.information.noalias() += weight * jacobian.transpose() * jacobian;
    slope.gradient.noalias() += weight * jacobian.transpose() * Eigen::Map<const Eigen::Vector3d>(r.data());
  }
  slope.information.diagonal().array() += 1e-6;
  return slope;
}

// One Gauss-Newton step; returns its length (radians and metres together).
double step(const Slope& slope, Pose& camera_from_world) {
  const Vector6 delta = -slope.information.ldlt().solve(slope.gradient);
  if (!delta.allFinite()) return 0;
  camera_from_world =
      updated(camera_from_world, {delta[0], delta[1], delta[2]}, {delta[3], delta[4], delta[5]});
  return delta.norm();
}

// How well the pose is known, if the noise is `squared_scale` of what the measurements promise.
void set_deviations(const Slope& slope, double squared_scale, PoseEstimate& estimate) {
  const Matrix6 covariance = squared_scale * slope.information.inverse();
  estimate.deviation_rad = std::sqrt(covariance.topLeftCorner<3, 3>().trace() / 3);
  estimate.deviation_m = std::sqrt(covariance.bottomRightCorner<3, 3>().trace() / 3);
}

std::vector<double> all_chi_squares(const std::vector<Correspondence>& correspondences,
                                    const Pinhole& pinhole, const Pose& camera_from_world) {
  std::vector<double> chi_squares;
  for (const Correspondence& c : correspondences) {
    const Vec3 p = camera_from_world * c.point;
    chi_squares.push_back(p.z < kProjectable_m ? 1e9 : squared(residual_of(c.measurement, pinhole, p)));
  }
  return chi_squares;
}

// Median of the residuals over the median of their distribution.
double noise_scale_squared(const std::vector<Correspondence>& correspondences,
                           const std::vector<double>& chi_squares) {
  constexpr double kMedian2 = 1.386, kMedian3 = 2.366;  // of chi-square with 2 and 3 degrees of freedom
  std::vector<double> ratios;
  for (std::size_t i = 0; i < chi_squares.size(); ++i)
    ratios.push_back(chi_squares[i] /
                     (correspondences[i].measurement.inverse_depth > 0 ? kMedian3 : kMedian2));
  std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
  return std::clamp(ratios[ratios.size() / 2], 1.0, kLargestScale * kLargestScale);
}

double reprojection_error_px(const std::vector<Correspondence>& correspondences, const Pinhole& pinhole,
                             const PoseEstimate& estimate) {
  double sum = 0;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    if (!estimate.inlier[i]) continue;
    const Measurement& measurement = correspondences[i].measurement;
    const Pixel pixel = pinhole.project(estimate.camera_from_world * correspondences[i].point);
    sum += (pixel.u - measurement.u_px) * (pixel.u - measurement.u_px) +
           (pixel.v - measurement.v_px) * (pixel.v - measurement.v_px);
  }
  return estimate.inliers > 0 ? std::sqrt(sum / estimate.inliers) : 0;
}

}  // namespace

Pose updated(const Pose& camera_from_world, Vec3 rotation_rad, Vec3 translation_m) {
  Pose next = rotation_from(rotation_rad) * camera_from_world;
  next.translation = next.translation + translation_m;
  return next;
}

PoseEstimate estimate_pose(const std::vector<Correspondence>& correspondences, const Pinhole& pinhole,
                           const Pose& camera_from_world_start, std::span<const AlignedView> views) {
  PoseEstimate estimate;
  estimate.camera_from_world = camera_from_world_start;
  estimate.inlier.assign(correspondences.size(), 1);
  if (correspondences.empty()) return estimate;
  double squared_scale = kLargestScale * kLargestScale;
  const auto slope = [&] {
    return slope_at(correspondences, estimate.inlier, pinhole, squared_scale, views,
                    estimate.camera_from_world);
  };
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < kStepsPerRound; ++i)
      if (step(slope(), estimate.camera_from_world) < 1e-7) break;
    const auto chi_squares = all_chi_squares(correspondences, pinhole, estimate.camera_from_world);
    squared_scale = noise_scale_squared(correspondences, chi_squares);
    estimate.inliers = 0;
    for (std::size_t i = 0; i < correspondences.size(); ++i) {
      estimate.inlier[i] = chi_squares[i] <= squared_scale * chi_square_bound(correspondences[i].measurement);
      estimate.inliers += estimate.inlier[i];
    }
    if (estimate.inliers < 3) break;
  }
  // Many products of rotations leave the group by rounding.
  estimate.camera_from_world =
      pose_from(quaternion_of(estimate.camera_from_world), estimate.camera_from_world.translation);
  estimate.noise_scale = std::sqrt(squared_scale);
  set_deviations(slope(), squared_scale, estimate);
  estimate.residual_px = reprojection_error_px(correspondences, pinhole, estimate);
  return estimate;
}

}  // namespace sediment::track
