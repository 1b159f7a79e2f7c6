#include "stages/project2d/plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace sediment::project2d {

PlaneFit fit_plane(std::span<const Vec3> points) {
  const auto count = static_cast<double>(points.size());
  Vec3 sum;
  for (const Vec3 p : points) sum = sum + p;
  const Vec3 centroid = sum / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vec3 p : points) {
    const Eigen::Vector3d d(p.x - centroid.x, p.y - centroid.y, p.z - centroid.z);
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);  // eigenvalues ascend
  const Eigen::Vector3d least = solver.eigenvectors().col(0);
  const Vec3 normal = normalized({least.x(), least.y(), least.z()});
  const auto rms = [&](int i) { return std::sqrt(std::max(0.0, solver.eigenvalues()[i]) / count); };
  return {{normal, -dot(normal, centroid)}, centroid, rms(0), rms(1)};
}

Pose map_from_world(const Plane& ground) {
  const Vec3 up = ground.normal;
  const Vec3 forward = std::abs(up.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  const Vec3 x = normalized(forward - dot(forward, up) * up);
  const Vec3 y = cross(up, x);
  return {{x.x, x.y, x.z, y.x, y.y, y.z, up.x, up.y, up.z}, {0, 0, ground.offset_m}};
}

}  // namespace sediment::project2d
