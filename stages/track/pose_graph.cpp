#include "stages/track/pose_graph.hpp"

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <stdexcept>

#include "stages/track/link_residual.hpp"
#include "stages/track/pose_manifold.hpp"

namespace sediment::track {
namespace {

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
