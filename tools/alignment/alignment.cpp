#include "tools/alignment/alignment.hpp"

#include <Eigen/Geometry>

namespace sediment::tools {
namespace {

Eigen::Matrix3Xd columns_of(const std::vector<Vec3>& points) {
  Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    matrix.col(static_cast<Eigen::Index>(i)) << points[i].x, points[i].y, points[i].z;
  return matrix;
}

}  // namespace

Pose Alignment::operator*(const Pose& pose) const {
  Pose aligned = truth_from_estimate * pose;
  aligned.translation = *this * pose.translation;
  return aligned;
}

std::optional<Alignment> align(const std::vector<Vec3>& truth, const std::vector<Vec3>& estimate,
                               bool with_scale) {
  const Eigen::Matrix3Xd to = columns_of(truth), from = columns_of(estimate);
  const Eigen::Matrix4d transform = Eigen::umeyama(from, to, with_scale);
  if (!transform.allFinite()) return std::nullopt;
  Alignment alignment;
  const Eigen::Matrix3d linear = transform.topLeftCorner<3, 3>();
  alignment.scale = with_scale ? std::cbrt(linear.determinant()) : 1;
  if (!(alignment.scale > 0)) return std::nullopt;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      alignment.truth_from_estimate.rotation[row * 3 + column] = linear(row, column) / alignment.scale;
  alignment.truth_from_estimate.translation = {transform(0, 3), transform(1, 3), transform(2, 3)};
  return alignment;
}

}  // namespace sediment::tools
