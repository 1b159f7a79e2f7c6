// The part of the normal equations that eliminates the points and finds them again.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "stages/track/normal_equations.hpp"

namespace sediment::track {
namespace {

constexpr double kLeastDiagonal = 1e-6;  // of what damping multiplies, as in Ceres

Eigen::Matrix3d damped_inverse(const Eigen::Matrix3d& matrix, double damping) {
  Eigen::Matrix3d damped = matrix;
  for (int i = 0; i < 3; ++i) damped(i, i) += damping * std::max(kLeastDiagonal, matrix(i, i));
  return damped.inverse();
}

}  // namespace

void NormalEquations::eliminate_point(std::size_t point_idx, double damping, Part& part) const {
  const Eigen::Matrix3d inverse = damped_inverse(own_[point_idx], damping);
  const auto subtract = [&](int row, const Tall& mixed, std::size_t next) {
    Tall scaled;
    scaled.noalias() = mixed * inverse;
    part.right[row].noalias() += scaled * slope_[point_idx];
    for (std::size_t j = next; j < first_[point_idx + 1]; ++j) {
      Block& block = part.blocks[system_->position(row, sights_[j].row)];
      block.noalias() -= scaled * mixed_[j].transpose();
      if (j > next && sights_[j].row == row) block.noalias() -= mixed_[j] * scaled.transpose();  // seen twice
    }
    if (timing_row_ >= 0)
      part.blocks[system_->position(row, timing_row_)].noalias() -=
          scaled * mixed_timing_[point_idx].transpose();
  };
  for (std::size_t i = first_[point_idx]; i < first_[point_idx + 1]; ++i)
    if (sights_[i].row >= 0) subtract(sights_[i].row, mixed_[i], i);
  if (timing_row_ >= 0) subtract(timing_row_, mixed_timing_[point_idx], first_[point_idx + 1]);
}

double NormalEquations::substitute_point(std::size_t point_idx, double damping) {
  const Eigen::Matrix3d& own = own_[point_idx];
  Eigen::Vector3d right = -slope_[point_idx];
  for (std::size_t i = first_[point_idx]; i < first_[point_idx + 1]; ++i)
    if (sights_[i].row >= 0) right.noalias() -= mixed_[i].transpose() * step_[sights_[i].row];
  if (timing_row_ >= 0) right.noalias() -= mixed_timing_[point_idx].transpose() * step_[timing_row_];
  const Eigen::Vector3d step = damped_inverse(own, damping) * right;
  point_step_[point_idx] = step;
  double gain = -step.dot(slope_[point_idx]);
  for (int i = 0; i < 3; ++i) gain += damping * std::max(kLeastDiagonal, own(i, i)) * step[i] * step[i];
  return 0.5 * gain;
}

bool NormalEquations::solve(double damping) {
  std::vector<Part> parts(kParts);
  for_parts([&](std::size_t part, std::size_t begin, std::size_t end) {
    parts[part] = empty_part();
    for (std::size_t point = begin; point < end; ++point) eliminate_point(point, damping, parts[part]);
  });
  parts.push_back(direct_);
  Part reduced = sum(parts);
  const auto raised = [&](int row, int i) {
    return damping * std::max(kLeastDiagonal, direct_.blocks[system_->diagonal(row)](i, i));
  };
  for (int row = 0; row < system_->rows(); ++row)
    for (int i = 0; i < 6; ++i) reduced.blocks[system_->diagonal(row)](i, i) += raised(row, i);
  step_ = system_->solve(reduced.blocks, reduced.right);
  if (static_cast<int>(step_.size()) != system_->rows()) return false;
  promised_gain_ = 0;
  for (int row = 0; row < system_->rows(); ++row)
    for (int i = 0; i < 6; ++i)
      promised_gain_ +=
          0.5 * (step_[row][i] * direct_.right[row][i] + raised(row, i) * step_[row][i] * step_[row][i]);
  std::array<double, kParts> gains{};
  for_parts([&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t point = begin; point < end; ++point) gains[part] += substitute_point(point, damping);
  });
  for (const double gain : gains) promised_gain_ += gain;
  return std::isfinite(promised_gain_);
}

BundleState NormalEquations::moved(const BundleState& state) const {
  BundleState next = state;
  for (std::size_t i = 0; i < next.cameras.size(); ++i) {
    if (row_of_[i] < 0) continue;
    const Vector6& step = step_[row_of_[i]];
    next.cameras[i] = updated(next.cameras[i], {step[0], step[1], step[2]}, {step[3], step[4], step[5]});
  }
  for (std::size_t i = 0; i < next.points.size(); ++i)
    next.points[i] = next.points[i] + Vec3{point_step_[i][0], point_step_[i][1], point_step_[i][2]};
  if (timing_row_ >= 0)
    for (int i = 0; i < 2; ++i) next.timing[i] += step_[timing_row_][i];
  return next;
}

}  // namespace sediment::track
