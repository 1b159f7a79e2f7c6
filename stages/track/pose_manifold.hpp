#pragma once

#include <ceres/manifold.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sediment::track {

/// A camera as 7 numbers, quaternion (x y z w) and translation, moved by exp(rotation) on the left. Its
/// PlusJacobian is the identity over six columns: cost functions put their derivative by the six numbers of
/// the update into the first six columns and 0 into the last, which saves the chain through the quaternion.
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const Eigen::Vector3d w(delta[0], delta[1], delta[2]);
    const double angle = w.norm();
    Eigen::Quaterniond turn(1, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z());
    if (angle > 1e-9) turn = Eigen::AngleAxisd(angle, w / angle);
    const Eigen::Quaterniond q = (turn * Eigen::Map<const Eigen::Quaterniond>(x)).normalized();
    Eigen::Map<Eigen::Quaterniond> moved(x_plus_delta);
    moved = q;
    for (int i = 0; i < 3; ++i) x_plus_delta[4 + i] = x[4 + i] + delta[3 + i];
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> j(jacobian);
    j.setZero();
    j.topRows<6>().setIdentity();
    return true;
  }
  bool Minus(const double*, const double*, double*) const override { return false; }
  bool MinusJacobian(const double*, double*) const override { return false; }
};

}  // namespace sediment::track
