#include "stages/track/registration.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <random>

namespace sediment::track {
namespace {

constexpr int kMostDraws = 500;
constexpr double kConfidence = 0.999;
constexpr double kLoosen = 9;  // three points with noisy depth give a rough pose: 3 times the usual deviation

Vec3 measured_point(const Measurement& m, const Pinhole& pinhole) {
  const double z = 1 / m.inverse_depth;
  return {(m.u_px - pinhole.cx) / pinhole.fx * z, (m.v_px - pinhole.cy) / pinhole.fy * z, z};
}

bool fits(const Correspondence& c, const Pinhole& pinhole, const Pose& camera_from_world) {
  const Vec3 p = camera_from_world * c.point;
  if (p.z < 0.05) return false;
  const auto r = residual_of(c.measurement, pinhole, p);
  return r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < kLoosen * chi_square_bound(c.measurement);
}

// Draws needed so that one of them is free of outliers with the confidence wanted.
int draws_needed(double inlier_share) {
  const double clean = inlier_share * inlier_share * inlier_share;
  if (clean > 0.999) return 1;
  return static_cast<int>(
      std::min<double>(kMostDraws, std::ceil(std::log(1 - kConfidence) / std::log1p(-clean))));
}

}  // namespace

Pose rigid_alignment(const std::vector<Vec3>& source, const std::vector<Vec3>& target) {
  Eigen::Vector3d source_mean = Eigen::Vector3d::Zero(), target_mean = Eigen::Vector3d::Zero();
  const auto vector = [](Vec3 v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  for (const Vec3& v : source) source_mean += vector(v) / static_cast<double>(source.size());
  for (const Vec3& v : target) target_mean += vector(v) / static_cast<double>(target.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i)
    covariance += (vector(target[i]) - target_mean) * (vector(source[i]) - source_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  const Eigen::Quaterniond q(rotation);
  const Eigen::Vector3d t = target_mean - rotation * source_mean;
  return pose_from({q.x(), q.y(), q.z(), q.w()}, {t.x(), t.y(), t.z()});
}

std::optional<PoseEstimate> find_pose(const std::vector<Correspondence>& correspondences,
                                      const Pinhole& pinhole, int least_inliers) {
  std::vector<std::size_t> with_depth;
  for (std::size_t i = 0; i < correspondences.size(); ++i)
    if (correspondences[i].measurement.inverse_depth > 0) with_depth.push_back(i);
  if (with_depth.size() < 3 || static_cast<int>(correspondences.size()) < least_inliers) return {};

  std::mt19937 random(20170607);
  int most = 0, draws = kMostDraws;
  Pose best;
  for (int draw = 0; draw < draws; ++draw) {
    std::size_t drawn[3];
    for (std::size_t& d : drawn) d = with_depth[random() % with_depth.size()];
    if (drawn[0] == drawn[1] || drawn[1] == drawn[2] || drawn[0] == drawn[2]) continue;
    std::vector<Vec3> world, camera;
    for (const std::size_t i : drawn) {
      world.push_back(correspondences[i].point);
      camera.push_back(measured_point(correspondences[i].measurement, pinhole));
    }
    const Pose pose = rigid_alignment(world, camera);
    int inliers = 0;
    for (const Correspondence& c : correspondences) inliers += fits(c, pinhole, pose);
    if (inliers <= most) continue;
    most = inliers;
    best = pose;
    draws = draws_needed(static_cast<double>(most) / static_cast<double>(correspondences.size()));
  }
  if (most < std::min(least_inliers, 6)) return {};
  PoseEstimate estimate = estimate_pose(correspondences, pinhole, best);
  if (estimate.inliers < least_inliers) return {};
  return estimate;
}

}  // namespace sediment::track
