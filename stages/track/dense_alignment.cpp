#include "stages/track/dense_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "stages/track/dense_sums.hpp"

namespace sediment::track {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kIterations[kDenseLevels] = {5, 7, 10};
constexpr double kPixelsPerObservation = 25;  // neighbours whose errors are one and the same

Matrix6 information_of(const NormalEquations& equations) {
  Matrix6 full;
  int k = 0;
  for (int a = 0; a < 6; ++a)
    for (int b = a; b < 6; ++b) full(a, b) = full(b, a) = equations.total[k++] / kPixelsPerObservation;
  return full;
}

Vector6 gradient_of(const NormalEquations& equations) {
  return Eigen::Map<const Vector6>(equations.total.data() + 21) / kPixelsPerObservation;
}

}  // namespace

DenseAlignment align(const DenseImages& reference, const DenseImages& current, const DenseCamera& camera,
                     const Pose& start, int finest_level, double depth_noise) {
  DenseAlignment result;
  result.current_from_reference = start;
  DenseScales scales;
  Matrix6 information = Matrix6::Zero();
  for (int level = kDenseLevels - 1; level >= finest_level; --level) {
    for (int i = 0; i < kIterations[level]; ++i) {
      const DenseSums sums = sums_at(reference[level], current[level], camera, level,
                                     result.current_from_reference, scales, static_cast<float>(depth_noise));
      scales.distance = sums.distances.robust_deviation();
      scales.brightness = sums.differences.robust_deviation();
      if (sums.squared_brightness > 0)
        scales.gain =
            static_cast<float>(std::clamp(sums.cross_brightness / sums.squared_brightness, 0.5, 2.0));
      // Directions without information must not run away: a prior of 0.1 rad and 0.1 m about the last step.
      information = information_of(sums.equations);
      Matrix6 damped = information;
      damped.diagonal().array() += 100;
      const Vector6 delta = -damped.ldlt().solve(gradient_of(sums.equations));
      if (!delta.allFinite()) break;
      Pose& pose = result.current_from_reference;
      pose = rotation_from({delta[0], delta[1], delta[2]}) * pose;
      pose.translation = pose.translation + Vec3{delta[3], delta[4], delta[5]};
      result.overlap =
          static_cast<double>(sums.seen) / std::max<std::size_t>(1, reference[level].points.size());
      result.residual_m = scales.distance * depth_noise;
      if (delta.norm() < 1e-5) break;
    }
  }
  result.current_from_reference =
      pose_from(quaternion_of(result.current_from_reference), result.current_from_reference.translation);
  // The steps turned the translation as well: v = e + [t]x w takes the error's derivative to the step's.
  const Vec3 t = result.current_from_reference.translation;
  Matrix6 step_from_error = Matrix6::Identity();
  step_from_error.bottomLeftCorner<3, 3>() << 0, -t.z, t.y, t.z, 0, -t.x, -t.y, t.x, 0;
  const Matrix6 turned = step_from_error.transpose() * information * step_from_error;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(result.information.data()) = turned;
  return result;
}

double worst_deviation(const DenseAlignment& alignment) {
  const Matrix6 information =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(alignment.information.data());
  const double least =
      Eigen::SelfAdjointEigenSolver<Matrix6>(information, Eigen::EigenvaluesOnly).eigenvalues()[0];
  return least > 0 ? 1 / std::sqrt(least) : std::numeric_limits<double>::infinity();
}

}  // namespace sediment::track
