#include "tests/stages/track/ceres_adjustment.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <stdexcept>

#include "stages/track/link_residual.hpp"
#include "stages/track/pose_manifold.hpp"

namespace sediment::track::test {
namespace {

using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// The residual of one observation and its derivatives by camera and point.
bool evaluate(const Measurement& measurement, const Pinhole& pinhole, double const* camera,
              double const* point, double* residuals, double* by_camera, double* by_position) {
  const RowMajor3 rotation = Eigen::Map<const Eigen::Quaterniond>(camera).toRotationMatrix();
  const Eigen::Vector3d turned = rotation * Eigen::Map<const Eigen::Vector3d>(point);
  const Vec3 p{turned.x() + camera[4], turned.y() + camera[5], turned.z() + camera[6]};
  if (p.z < kProjectable_m) return false;  // the step is refused and shortened
  const auto r = residual_of(measurement, pinhole, p);
  std::copy(r.begin(), r.end(), residuals);
  if (!by_camera && !by_position) return true;
  const auto by_point_values = residual_by_point(measurement, pinhole, p);
  const Eigen::Map<const RowMajor3> by_point(by_point_values.data());
  if (by_camera) {
    Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>> j(by_camera);
    RowMajor3 cross;  // derivative of exp(w) q by w: -[q]x, q = R * point
    cross << 0, turned.z(), -turned.y(), -turned.z(), 0, turned.x(), turned.y(), -turned.x(), 0;
    j.leftCols<3>().noalias() = by_point * cross;
    j.middleCols<3>(3) = by_point;
    j.col(6).setZero();
  }
  if (by_position) Eigen::Map<RowMajor3>(by_position).noalias() = by_point * rotation;
  return true;
}

class ObservationCost : public ceres::SizedCostFunction<3, 7, 3> {
 public:
  ObservationCost(const Measurement& measurement, const Pinhole& pinhole)
      : measurement_(measurement), pinhole_(pinhole) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    return evaluate(measurement_, pinhole_, parameters[0], parameters[1], residuals,
                    jacobians ? jacobians[0] : nullptr, jacobians ? jacobians[1] : nullptr);
  }

 private:
  const Measurement& measurement_;
  const Pinhole& pinhole_;
};

// The same with the change of the sensor's timing (readout, depth lag) as a third block.
class TimedObservationCost : public ceres::SizedCostFunction<3, 7, 3, 2> {
 public:
  TimedObservationCost(const Measurement& measurement, const Pinhole& pinhole)
      : measurement_(measurement), pinhole_(pinhole) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    Measurement timed = measurement_;
    timed.u_px += parameters[2][0] * timed.u_rate;
    timed.v_px += parameters[2][0] * timed.v_rate;
    if (timed.inverse_depth > 0) timed.inverse_depth += parameters[2][1] * timed.depth_rate;
    if (jacobians && jacobians[2]) {
      Eigen::Map<Eigen::Matrix<double, 3, 2, Eigen::RowMajor>> j(jacobians[2]);
      j << -timed.pixel_weight * timed.u_rate, 0, -timed.pixel_weight * timed.v_rate, 0, 0,
          timed.inverse_depth > 0 ? -timed.depth_weight * timed.depth_rate : 0.0;
    }
    return evaluate(timed, pinhole_, parameters[0], parameters[1], residuals,
                    jacobians ? jacobians[0] : nullptr, jacobians ? jacobians[1] : nullptr);
  }

 private:
  const Measurement& measurement_;
  const Pinhole& pinhole_;
};

// A link in units of standard deviations.
class LinkCost : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit LinkCost(const Bundle::Link& link) : link_(link) {
    const Eigen::Map<const RowMajor6> information(link.information.data());
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> ldlt(information);
    // information = P^T L D L^T P, and its root is sqrt(D) L^T P.
    root_ = ldlt.vectorD().cwiseMax(0).cwiseSqrt().asDiagonal() *
            Eigen::Matrix<double, 6, 6>(ldlt.matrixU()) *
            Eigen::Matrix<double, 6, 6>(ldlt.transpositionsP() * Eigen::Matrix<double, 6, 6>::Identity());
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const auto pose = [](const double* x) { return pose_from({x[0], x[1], x[2], x[3]}, {x[4], x[5], x[6]}); };
    const LinkResidual r = link_residual(pose(parameters[0]), pose(parameters[1]), link_.to_from_from);
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(residuals).noalias() =
        root_ * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(r.error.data());
    for (int i = 0; jacobians && i < 2; ++i) {
      if (!jacobians[i]) continue;
      Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> j(jacobians[i]);
      j.leftCols<6>().noalias() = root_ * Eigen::Map<const RowMajor6>((i == 0 ? r.by_from : r.by_to).data());
      j.col(6).setZero();
    }
    return true;
  }

 private:
  Bundle::Link link_;
  Eigen::Matrix<double, 6, 6> root_;
};

// Weak knowledge of the timing: within 1/30 s, the period of a frame.
class TimingPrior : public ceres::SizedCostFunction<2, 2> {
 public:
  explicit TimingPrior(const SensorTiming& start) : start_(start) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = 30 * (start_.readout_s + parameters[0][0]);
    residuals[1] = 30 * (start_.depth_lag_s + parameters[0][1]);
    if (jacobians && jacobians[0]) {
      jacobians[0][0] = jacobians[0][3] = 30;
      jacobians[0][1] = jacobians[0][2] = 0;
    }
    return true;
  }

 private:
  SensorTiming start_;
};

ceres::Solver::Options options_of(const AdjustmentRule& rule) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // no BLAS whose threads change the sums
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.num_threads = 1;
  options.max_num_iterations = rule.max_iterations;
  options.function_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

double adjust_with_ceres(Bundle& bundle, const Pinhole& pinhole, const AdjustmentRule& rule) {
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  PoseManifold manifold;
  ceres::HuberLoss huber2(std::sqrt(kChiSquare2)), huber3(std::sqrt(kChiSquare3)), huber6(std::sqrt(12.592));
  ceres::Problem problem(ownership);
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();

  std::array<double, 2> timing{};  // change of the timing
  if (rule.timing) {
    problem.AddParameterBlock(timing.data(), 2);
    ordering->AddElementToGroup(timing.data(), 1);
    problem.AddResidualBlock(new TimingPrior(bundle.timing), nullptr, timing.data());
  }
  std::vector<std::array<double, 7>> cameras(bundle.cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Quaternion q = quaternion_of(bundle.cameras[i].camera_from_world);
    const Vec3 t = bundle.cameras[i].camera_from_world.translation;
    cameras[i] = {q.x, q.y, q.z, q.w, t.x, t.y, t.z};
    problem.AddParameterBlock(cameras[i].data(), 7, &manifold);
    ordering->AddElementToGroup(cameras[i].data(), 1);
    if (bundle.cameras[i].fixed) problem.SetParameterBlockConstant(cameras[i].data());
  }
  for (Vec3& point : bundle.points) {
    problem.AddParameterBlock(&point.x, 3);
    ordering->AddElementToGroup(&point.x, 0);
  }
  for (const Bundle::Observation& o : bundle.observations) {
    ceres::LossFunction* loss = !rule.robust ? nullptr : o.measurement.inverse_depth > 0 ? &huber3 : &huber2;
    double *const camera = cameras[o.camera_idx].data(), *const point = &bundle.points[o.point_idx].x;
    if (rule.timing)
      problem.AddResidualBlock(new TimedObservationCost(o.measurement, pinhole), loss, camera, point,
                               timing.data());
    else
      problem.AddResidualBlock(new ObservationCost(o.measurement, pinhole), loss, camera, point);
  }
  for (const Bundle::Link& link : bundle.links)
    problem.AddResidualBlock(new LinkCost(link), rule.robust ? &huber6 : nullptr,
                             cameras[link.from_idx].data(), cameras[link.to_idx].data());
  ceres::Solver::Options options = options_of(rule);
  options.linear_solver_ordering = ordering;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw std::runtime_error("bundle adjustment failed: " + summary.message);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (!bundle.cameras[i].fixed)
      bundle.cameras[i].camera_from_world =
          pose_from({cameras[i][0], cameras[i][1], cameras[i][2], cameras[i][3]},
                    {cameras[i][4], cameras[i][5], cameras[i][6]});
  bundle.timing.readout_s += timing[0];
  bundle.timing.depth_lag_s += timing[1];
  return summary.final_cost;
}

}  // namespace sediment::track::test
