#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/scene/trajectory.hpp"

namespace sediment::tools {

/// A pose of the truth and a pose of the estimate at (nearly) the same time.
struct Match {
  std::size_t truth_idx = 0, estimate_idx = 0;
};

/// TUM's associate.py: stamps closer than `tolerance_s`, the closest pairs first, each pose once.
std::vector<Match> match_as_tum(const Trajectory& truth, const Trajectory& estimate,
                                double tolerance_s = 0.02);

/// evo's associate_trajectories: for each pose of the shorter trajectory (of the estimate, if both are as
/// long) the nearest of the other, up to and including `tolerance_s`. A pose may be used more than once.
std::vector<Match> match_as_evo(const Trajectory& truth, const Trajectory& estimate,
                                double tolerance_s = 0.01);

/// Seconds, in the order of the poses.
std::vector<double> stamps_of(const Trajectory& trajectory);

/// Index of the value nearest to `value` in an ascending list that is not empty: the search of
/// evaluate_rpe.py, with its choice between two that are equally near.
std::size_t closest_index(const std::vector<double>& ascending, double value);

}  // namespace sediment::tools
