#pragma once

#include "stages/track/block_system.hpp"
#include "stages/track/bundle_adjustment.hpp"

namespace sediment::track {

inline constexpr double kChiSquare6 = 12.592;  ///< 95 % bound with 6 degrees of freedom

/// Huber's loss of a squared residual, quadratic up to `bound`.
inline double huber(double squares, double bound) {
  return squares <= bound ? squares : 2 * std::sqrt(bound * squares) - bound;
}
inline double huber_weight(double squares, double bound) {
  return squares <= bound ? 1 : std::sqrt(bound / squares);
}

/// A link between two cameras in units of standard deviations, and its derivatives by the updates of both.
struct LinkTerms {
  Vector6 residual;
  Block by_from, by_to;
  double weight = 1;  ///< of the loss
  double cost = 0;
};

/// R with R^T R = information.
Block root_of(const std::array<double, 36>& information);

LinkTerms linked(const Bundle::Link& link, const Block& root, const std::vector<Pose>& cameras, bool robust);

/// Weak knowledge of the timing: within 1/30 s, the period of a frame. Twice its cost, and its derivatives.
double timing_cost(const SensorTiming& start, const std::array<double, 2>& change);
void add_timing_prior(const SensorTiming& start, const std::array<double, 2>& change, Block& block,
                      Vector6& right);

}  // namespace sediment::track
