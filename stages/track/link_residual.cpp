#include "stages/track/link_residual.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sediment::track {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

RowMajor3 cross_matrix(const Vec3& v) {
  RowMajor3 m;
  m << 0, -v.z, v.y, v.z, 0, -v.x, -v.y, v.x, 0;
  return m;
}

}  // namespace

LinkResidual link_residual(const Pose& from, const Pose& to, const Pose& to_from_from) {
  const Pose relative = to * from.inverse();
  const Pose turn = relative * to_from_from.inverse();
  const Vec3 rotation = rotation_vector(turn);
  const Vec3 translation = relative.translation - to_from_from.translation;
  LinkResidual residual;
  residual.error = {rotation.x, rotation.y, rotation.z, translation.x, translation.y, translation.z};
  Eigen::Map<RowMajor6> by_from(residual.by_from.data()), by_to(residual.by_to.data());
  const Eigen::Map<const RowMajor3> r(relative.rotation.data());
  by_to.setIdentity();
  by_to.bottomLeftCorner<3, 3>() = cross_matrix(relative.rotate(from.translation));
  by_from.topLeftCorner<3, 3>() = -r;
  by_from.bottomLeftCorner<3, 3>() = -r * cross_matrix(from.translation);
  by_from.bottomRightCorner<3, 3>() = -r;
  return residual;
}

}  // namespace sediment::track
