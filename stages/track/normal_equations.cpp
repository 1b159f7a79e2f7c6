#include "stages/track/normal_equations.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "stages/track/bundle_links.hpp"

namespace sediment::track {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Wide = Eigen::Matrix<double, 3, 6>;

Measurement retimed(const Measurement& measurement, const std::array<double, 2>& timing) {
  Measurement timed = measurement;
  timed.u_px += timing[0] * timed.u_rate;
  timed.v_px += timing[0] * timed.v_rate;
  if (timed.inverse_depth > 0) timed.inverse_depth += timing[1] * timed.depth_rate;
  return timed;
}

}  // namespace

NormalEquations::NormalEquations(const Bundle& bundle, const Pinhole& pinhole, const AdjustmentRule& rule)
    : bundle_(bundle), pinhole_(pinhole), rule_(rule) {
  int rows = 0;
  for (const Bundle::Camera& camera : bundle.cameras) row_of_.push_back(camera.fixed ? -1 : rows++);
  if (rule.timing) timing_row_ = rows++;
  std::vector<std::size_t> order(bundle.observations.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto &left = bundle.observations[a], &right = bundle.observations[b];
    return left.point_idx != right.point_idx ? left.point_idx < right.point_idx
                                             : row_of_[left.camera_idx] < row_of_[right.camera_idx];
  });
  first_.assign(bundle.points.size() + 1, 0);
  for (const std::size_t i : order) {
    const Bundle::Observation& o = bundle.observations[i];
    sights_.push_back({row_of_[o.camera_idx], o.camera_idx, &o.measurement});
    ++first_[o.point_idx + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<char> together(static_cast<std::size_t>(rows) * rows, 0);
  for (std::size_t point = 0; point < bundle.points.size(); ++point)
    for (std::size_t a = first_[point]; a < first_[point + 1]; ++a)
      for (std::size_t b = a; b < first_[point + 1] && sights_[a].row >= 0; ++b)
        together[static_cast<std::size_t>(sights_[a].row) * rows + sights_[b].row] = 1;
  for (const Bundle::Link& link : bundle.links) {
    link_roots_.push_back(root_of(link.information));
    const auto [low, high] = std::minmax(row_of_[link.from_idx], row_of_[link.to_idx]);
    if (low >= 0) together[static_cast<std::size_t>(low) * rows + high] = 1;
  }
  std::vector<std::pair<int, int>> pairs;
  for (int row = 0; row < rows; ++row)
    for (int column = row; column < rows; ++column)
      if (together[static_cast<std::size_t>(row) * rows + column] || column == timing_row_)
        pairs.emplace_back(row, column);
  system_ = std::make_unique<BlockSystem>(rows, std::move(pairs));
  mixed_.resize(sights_.size());
  own_.resize(bundle.points.size());
  slope_.resize(bundle.points.size());
  point_step_.resize(bundle.points.size());
  if (timing_row_ >= 0) mixed_timing_.resize(bundle.points.size());
}

void NormalEquations::for_parts(const PartWork& work) const {
  const std::size_t points = bundle_.points.size();
  const auto part = [&](std::size_t i) { work(i, points * i / kParts, points * (i + 1) / kParts); };
  // A part of a larger computation that waits for others could be given their work meanwhile: only what
  // stands alone is spread over threads.
  if (rule_.parallel)
    tbb::parallel_for(std::size_t{0}, kParts, part);
  else
    for (std::size_t i = 0; i < kParts; ++i) part(i);
}

NormalEquations::Part NormalEquations::empty_part() const {
  return {std::vector<Block>(system_->blocks(), Block::Zero()),
          std::vector<Vector6>(system_->rows(), Vector6::Zero())};
}

NormalEquations::Part NormalEquations::sum(const std::vector<Part>& parts) const {
  Part total = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    for (std::size_t k = 0; k < total.blocks.size(); ++k) total.blocks[k] += parts[i].blocks[k];
    for (std::size_t k = 0; k < total.right.size(); ++k) total.right[k] += parts[i].right[k];
  }
  return total;
}

double NormalEquations::cost(const BundleState& state) const {
  std::array<double, kParts> costs{};
  for_parts([&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t point = begin; point < end; ++point)
      for (std::size_t i = first_[point]; i < first_[point + 1]; ++i) {
        const Measurement measurement = retimed(*sights_[i].measurement, state.timing);
        const Vec3 p = state.cameras[sights_[i].camera_idx] * state.points[point];
        const double squares = p.z < kProjectable_m ? std::numeric_limits<double>::infinity()
                                                    : squared(residual_of(measurement, pinhole_, p));
        costs[part] += 0.5 * (rule_.robust ? huber(squares, chi_square_bound(measurement)) : squares);
      }
  });
  double total = link_cost(state);
  for (const double cost : costs) total += cost;
  if (timing_row_ >= 0) total += 0.5 * timing_cost(bundle_.timing, state.timing);
  return total;
}

double NormalEquations::link_cost(const BundleState& state) const {
  double total = 0;
  for (std::size_t i = 0; i < bundle_.links.size(); ++i)
    total += linked(bundle_.links[i], link_roots_[i], state.cameras, rule_.robust).cost;
  return total;
}

void NormalEquations::linearise_point(const BundleState& state, std::size_t point_idx, Part& part) {
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  Tall with_timing = Tall::Zero();
  for (std::size_t i = first_[point_idx]; i < first_[point_idx + 1]; ++i) {
    const int row = sights_[i].row;
    const Measurement measurement = retimed(*sights_[i].measurement, state.timing);
    const Pose& pose = state.cameras[sights_[i].camera_idx];
    const Vec3 turned = pose.rotate(state.points[point_idx]), p = turned + pose.translation;
    const auto residual = residual_of(measurement, pinhole_, p);
    const auto by_point_values = residual_by_point(measurement, pinhole_, p);
    const Eigen::Map<const RowMajor3> by_point(by_point_values.data());
    const double weight = rule_.robust ? huber_weight(squared(residual), chi_square_bound(measurement)) : 1;
    const Eigen::Vector3d r = weight * Eigen::Map<const Eigen::Vector3d>(residual.data());
    Eigen::Matrix3d by_position;
    by_position.noalias() = by_point * Eigen::Map<const RowMajor3>(pose.rotation.data());
    const Eigen::Matrix3d weighted = weight * by_position;
    own.noalias() += weighted.transpose() * by_position;
    slope.noalias() += by_position.transpose() * r;
    Wide by_camera;
    if (row >= 0) {
      RowMajor3 cross;  // derivative of exp(w) q by w: -[q]x, q = R * point
      cross << 0, turned.z, -turned.y, -turned.z, 0, turned.x, turned.y, -turned.x, 0;
      by_camera.leftCols<3>().noalias() = by_point * cross;
      by_camera.rightCols<3>() = by_point;
      const Wide heavy = weight * by_camera;
      mixed_[i].noalias() = by_camera.transpose() * weighted;
      part.blocks[system_->diagonal(row)].noalias() += heavy.transpose() * by_camera;
      part.right[row].noalias() -= by_camera.transpose() * r;
    }
    if (timing_row_ < 0) continue;
    Wide by_timing = Wide::Zero();
    by_timing(0, 0) = -measurement.pixel_weight * measurement.u_rate;
    by_timing(1, 0) = -measurement.pixel_weight * measurement.v_rate;
    by_timing(2, 1) = measurement.inverse_depth > 0 ? -measurement.depth_weight * measurement.depth_rate : 0;
    const Wide heavy = weight * by_timing;
    part.blocks[system_->diagonal(timing_row_)].noalias() += heavy.transpose() * by_timing;
    part.right[timing_row_].noalias() -= by_timing.transpose() * r;
    with_timing.noalias() += by_timing.transpose() * weighted;
    if (row >= 0) part.blocks[system_->position(row, timing_row_)].noalias() += by_camera.transpose() * heavy;
  }
  own_[point_idx] = own;
  slope_[point_idx] = slope;
  if (timing_row_ >= 0) mixed_timing_[point_idx] = with_timing;
}

void NormalEquations::add_links(const BundleState& state, Part& part) const {
  for (std::size_t i = 0; i < bundle_.links.size(); ++i) {
    const LinkTerms terms = linked(bundle_.links[i], link_roots_[i], state.cameras, rule_.robust);
    const int from = row_of_[bundle_.links[i].from_idx], to = row_of_[bundle_.links[i].to_idx];
    const auto add = [&](int row, const Block& by) {
      if (row < 0) return;
      part.blocks[system_->diagonal(row)].noalias() += terms.weight * by.transpose() * by;
      part.right[row].noalias() -= terms.weight * by.transpose() * terms.residual;
    };
    add(from, terms.by_from);
    add(to, terms.by_to);
    if (from < 0 || to < 0) continue;
    const Block mixed = terms.weight * terms.by_from.transpose() * terms.by_to;
    part.blocks[system_->position(std::min(from, to), std::max(from, to))] +=
        from < to ? mixed : Block(mixed.transpose());
  }
}

void NormalEquations::linearise(const BundleState& state) {
  std::vector<Part> parts(kParts);
  for_parts([&](std::size_t part, std::size_t begin, std::size_t end) {
    parts[part] = empty_part();
    for (std::size_t point = begin; point < end; ++point) linearise_point(state, point, parts[part]);
  });
  direct_ = sum(parts);
  add_links(state, direct_);
  if (timing_row_ < 0) return;
  Block& block = direct_.blocks[system_->diagonal(timing_row_)];
  block.diagonal().tail<4>().setOnes();  // not used
  add_timing_prior(bundle_.timing, state.timing, block, direct_.right[timing_row_]);
}

}  // namespace sediment::track
