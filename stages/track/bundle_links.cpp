#include "stages/track/bundle_links.hpp"

#include <Eigen/Cholesky>

#include "stages/track/link_residual.hpp"

namespace sediment::track {
namespace {

using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
constexpr double kTimingWeight = 30 * 30;  // 1/s^2

}  // namespace

Block root_of(const std::array<double, 36>& values) {
  const Eigen::Map<const RowMajor6> information(values.data());
  const Eigen::LDLT<Block> ldlt(information);
  // information = P^T L D L^T P, and its root is sqrt(D) L^T P.
  return ldlt.vectorD().cwiseMax(0).cwiseSqrt().asDiagonal() * Block(ldlt.matrixU()) *
         Block(ldlt.transpositionsP() * Block::Identity());
}

LinkTerms linked(const Bundle::Link& link, const Block& root, const std::vector<Pose>& cameras, bool robust) {
  const LinkResidual r = link_residual(cameras[link.from_idx], cameras[link.to_idx], link.to_from_from);
  LinkTerms terms;
  terms.residual = root * Eigen::Map<const Vector6>(r.error.data());
  terms.by_from = root * Eigen::Map<const RowMajor6>(r.by_from.data());
  terms.by_to = root * Eigen::Map<const RowMajor6>(r.by_to.data());
  const double squares = terms.residual.squaredNorm();
  if (robust) terms.weight = huber_weight(squares, kChiSquare6);
  terms.cost = 0.5 * (robust ? huber(squares, kChiSquare6) : squares);
  return terms;
}

double timing_cost(const SensorTiming& start, const std::array<double, 2>& change) {
  const double readout_s = start.readout_s + change[0], lag_s = start.depth_lag_s + change[1];
  return kTimingWeight * (readout_s * readout_s + lag_s * lag_s);
}

void add_timing_prior(const SensorTiming& start, const std::array<double, 2>& change, Block& block,
                      Vector6& right) {
  block(0, 0) += kTimingWeight;
  block(1, 1) += kTimingWeight;
  right[0] -= kTimingWeight * (start.readout_s + change[0]);
  right[1] -= kTimingWeight * (start.depth_lag_s + change[1]);
}

}  // namespace sediment::track
