#include "stages/track/pose_graph.hpp"

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <stdexcept>

#include "stages/track/link_residual.hpp"

namespace sediment::track {
namespace {

// A camera as 7 numbers, quaternion (x y z w) and translation, moved by exp(rotation) on the left. Its
// PlusJacobian is the identity over six columns: cost functions put their derivative by the six numbers of
// the update into the first six columns and 0 into the last, which saves the chain through the quaternion.
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

class EdgeCost : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit EdgeCost(const PoseGraph::Edge& edge) : edge_(edge), root_(1000 * std::sqrt(edge.weight)) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const auto pose = [](const double* x) { return pose_from({x[0], x[1], x[2], x[3]}, {x[4], x[5], x[6]}); };
    const LinkResidual r = link_residual(pose(parameters[0]), pose(parameters[1]), edge_.to_from_from);
    for (int i = 0; i < 6; ++i) residuals[i] = root_ * r.error[i];
    for (int i = 0; jacobians && i < 2; ++i) {
      if (!jacobians[i]) continue;
      const auto& by = i == 0 ? r.by_from : r.by_to;
      Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> j(jacobians[i]);
      j.leftCols<6>() = root_ * Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(by.data());
      j.col(6).setZero();
    }
    return true;
  }

 private:
  const PoseGraph::Edge& edge_;
  double root_;
};

}  // namespace

void relax(PoseGraph& graph) {
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  PoseManifold manifold;
  ceres::Problem problem(ownership);
  std::vector<std::array<double, 7>> poses(graph.camera_from_world.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Quaternion q = quaternion_of(graph.camera_from_world[i]);
    const Vec3 t = graph.camera_from_world[i].translation;
    poses[i] = {q.x, q.y, q.z, q.w, t.x, t.y, t.z};
    problem.AddParameterBlock(poses[i].data(), 7, &manifold);
    if (graph.fixed[i]) problem.SetParameterBlockConstant(poses[i].data());
  }
  for (const PoseGraph::Edge& edge : graph.edges)
    problem.AddResidualBlock(new EdgeCost(edge), nullptr, poses[edge.from_idx].data(),
                             poses[edge.to_idx].data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // no BLAS whose threads change the sums
  options.num_threads = 1;
  options.max_num_iterations = 30;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw std::runtime_error("pose graph: " + summary.message);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!graph.fixed[i])
      graph.camera_from_world[i] = pose_from({poses[i][0], poses[i][1], poses[i][2], poses[i][3]},
                                             {poses[i][4], poses[i][5], poses[i][6]});
}

}  // namespace sediment::track
