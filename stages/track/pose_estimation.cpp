#include "stages/track/pose_estimation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

namespace sediment::track {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr int kRounds = 4, kStepsPerRound = 6;
constexpr double kNearest_m = 0.05;  // a point nearer or behind cannot be projected

double squared(const std::array<double, 3>& r) {
  return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
}

// One Gauss-Newton step; returns its length (radians and metres together).
double step(const std::vector<Correspondence>& correspondences, const std::vector<char>& inlier,
            const Pinhole& pinhole, bool robust, Pose& camera_from_world) {
  Matrix6 information = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    if (!inlier[i]) continue;
    const Measurement& measurement = correspondences[i].measurement;
    const Vec3 p = camera_from_world * correspondences[i].point;
    if (p.z < kNearest_m) continue;
    const auto r = residual_of(measurement, pinhole, p);
    const auto by_point = residual_by_point(measurement, pinhole, p);
    const double bound = chi_square_bound(measurement), chi_square = squared(r);
    const double weight = robust && chi_square > bound ? std::sqrt(bound / chi_square) : 1.0;
    RowMajor3 cross;  // derivative of exp(w) p by w: -[p]x
    cross << 0, p.z, -p.y, -p.z, 0, p.x, p.y, -p.x, 0;
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian.rightCols<3>() = Eigen::Map<const RowMajor3>(by_point.data());
    jacobian.leftCols<3>().noalias() = jacobian.rightCols<3>() * cross;
    information.noalias() += weight * jacobian.transpose() * jacobian;
    gradient.noalias() += weight * jacobian.transpose() * Eigen::Map<const Eigen::Vector3d>(r.data());
  }
  information.diagonal().array() += 1e-6;
  const Vector6 delta = -information.ldlt().solve(gradient);
  if (!delta.allFinite()) return 0;
  camera_from_world =
      updated(camera_from_world, {delta[0], delta[1], delta[2]}, {delta[3], delta[4], delta[5]});
  return delta.norm();
}

}  // namespace

Pose updated(const Pose& camera_from_world, Vec3 rotation_rad, Vec3 translation_m) {
  Pose next = rotation_from(rotation_rad) * camera_from_world;
  next.translation = next.translation + translation_m;
  return next;
}

PoseEstimate estimate_pose(const std::vector<Correspondence>& correspondences, const Pinhole& pinhole,
                           const Pose& camera_from_world_start) {
  PoseEstimate estimate;
  estimate.camera_from_world = camera_from_world_start;
  estimate.inlier.assign(correspondences.size(), 1);
  double squared_px = 0;
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < kStepsPerRound; ++i)
      if (step(correspondences, estimate.inlier, pinhole, round < kRounds - 1, estimate.camera_from_world) <
          1e-7)
        break;
    estimate.inliers = 0;
    squared_px = 0;
    for (std::size_t i = 0; i < correspondences.size(); ++i) {
      const Measurement& measurement = correspondences[i].measurement;
      const Vec3 p = estimate.camera_from_world * correspondences[i].point;
      const auto r =
          p.z < kNearest_m ? std::array<double, 3>{1e3, 1e3, 1e3} : residual_of(measurement, pinhole, p);
      estimate.inlier[i] = squared(r) <= chi_square_bound(measurement);
      if (!estimate.inlier[i]) continue;
      ++estimate.inliers;
      squared_px += (r[0] * r[0] + r[1] * r[1]) / (measurement.pixel_weight * measurement.pixel_weight);
    }
    if (estimate.inliers < 3) break;
  }
  // Many products of rotations leave the group by rounding.
  estimate.camera_from_world =
      pose_from(quaternion_of(estimate.camera_from_world), estimate.camera_from_world.translation);
  if (estimate.inliers > 0) estimate.residual_px = std::sqrt(squared_px / estimate.inliers);
  return estimate;
}

}  // namespace sediment::track
