#include "pipeline/scene/pose.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sediment {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Quaterniond eigen_quaternion(const Pose& pose) {
  Eigen::Quaterniond q(Eigen::Map<const RowMajor3>(pose.rotation.data()).eval());
  q.normalize();
  return q;
}

Pose pose_of(const Eigen::Quaterniond& q, Vec3 translation) {
  Pose pose;
  Eigen::Map<RowMajor3>(pose.rotation.data()) = q.toRotationMatrix();
  pose.translation = translation;
  return pose;
}

}  // namespace

Pose Pose::operator*(const Pose& right) const {
  Pose product;
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col)
      product.rotation[row * 3 + col] = rotation[row * 3] * right.rotation[col] +
                                        rotation[row * 3 + 1] * right.rotation[3 + col] +
                                        rotation[row * 3 + 2] * right.rotation[6 + col];
  product.translation = *this * right.translation;
  return product;
}

Pose Pose::inverse() const {
  const auto& r = rotation;
  Pose inverted;
  inverted.rotation = {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]};
  inverted.translation = -inverted.rotate(translation);
  return inverted;
}

Pose pose_from(const Quaternion& rotation, Vec3 translation) {
  Eigen::Quaterniond q(rotation.w, rotation.x, rotation.y, rotation.z);
  const double length = q.norm();
  if (!(length > 1e-9) || !std::isfinite(length))
    throw std::invalid_argument("a quaternion of a pose has no direction (zero or not finite)");
  q.coeffs() /= length;
  return pose_of(q, translation);
}

Quaternion quaternion_of(const Pose& pose) {
  Eigen::Quaterniond q = eigen_quaternion(pose);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return {q.x(), q.y(), q.z(), q.w()};
}

Pose rotation_from(Vec3 axis_angle_rad) {
  const double angle = norm(axis_angle_rad);
  if (angle < 1e-12) return {};
  const Vec3 axis = axis_angle_rad / angle;
  return pose_of(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d(axis.x, axis.y, axis.z))), {});
}

Vec3 rotation_vector(const Pose& pose) {
  const Quaternion q = quaternion_of(pose);
  const Vec3 axis{q.x, q.y, q.z};
  const double sine = norm(axis);
  return (sine > 1e-12 ? 2 * std::atan2(sine, q.w) / sine : 2.0) * axis;
}

double rotation_angle(const Pose& pose) {
  const double trace = pose.rotation[0] + pose.rotation[4] + pose.rotation[8];
  return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0));
}

Pose interpolate(const Pose& from, const Pose& to, double fraction) {
  const Eigen::Quaterniond q = eigen_quaternion(from).slerp(fraction, eigen_quaternion(to));
  return pose_of(q, (1 - fraction) * from.translation + fraction * to.translation);
}

}  // namespace sediment
