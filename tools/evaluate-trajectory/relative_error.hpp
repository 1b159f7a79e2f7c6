#pragma once

#include <string>
#include <vector>

#include "pipeline/scene/trajectory.hpp"
#include "tools/evaluate-trajectory/matching.hpp"

namespace sediment::tools {

/// Error of the motion between two poses of the estimate.
struct RelativeError {
  std::size_t from_idx = 0, to_idx = 0;  ///< poses of the estimate
  double translation_m = 0;
  double rotation_deg = 0;
  double full = 0;  ///< Frobenius norm of error - identity (evo's "full transformation")
};

/// Which motions TUM's evaluate_rpe.py compares.
struct RelativePairs {
  enum class Rule { seconds, frames, random } rule = Rule::seconds;
  double delta = 1;               ///< of seconds and frames
  std::size_t max_pairs = 10000;  ///< of random
};

/// TUM's evaluate_rpe.py: for a pair (0, 1) the motion is inverse(T1) * T0, the error is inverse(motion of
/// the estimate) * (motion of the truth). Fixed deltas: from every pose to the one nearest to `delta` later;
/// a pair that ends at the last pose is dropped. (Of more than 10,000 such pairs the tool draws 10,000; here
/// all of them count.) Random: `max_pairs` draws with Python 2's random.seed(0); all pairs of a trajectory of
/// fewer than sqrt(max_pairs) poses. A pair counts if both poses have a true one within twice the median
/// interval of the truth.
std::vector<RelativeError> relative_errors_as_tum(const Trajectory& truth, const Trajectory& estimate,
                                                  const RelativePairs& pairs);

/// evo's RPE with a delta of one frame between consecutive matches: motion inverse(T0) * T1, error
/// inverse(motion of the truth) * (motion of the estimate). `scale` is applied to the estimate.
std::vector<RelativeError> relative_errors_as_evo(const Trajectory& truth, const Trajectory& estimate,
                                                  const std::vector<Match>& matches, double scale = 1);

/// Frobenius norm of the 4 x 4 matrix minus the identity.
double distance_from_identity(const Pose& pose);

/// Angle of a rotation in degrees, exact for small ones too (rotation_angle is TUM's arccos).
double exact_angle_deg(const Pose& pose);

}  // namespace sediment::tools
