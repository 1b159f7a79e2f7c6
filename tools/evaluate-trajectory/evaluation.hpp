#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifacts/trajectory_file.hpp"
#include "tools/alignment/alignment.hpp"
#include "tools/evaluate-trajectory/relative_error.hpp"
#include "tools/evaluate-trajectory/statistics.hpp"

namespace sediment::tools {

/// The frames that could have had a pose.
struct FrameCount {
  std::size_t frames = 0;
  std::string source;  ///< where the number comes from, for people
};

/// Absolute error of the positions, TUM's evaluate_ate.py.
struct AbsoluteError {
  std::vector<Match> matches;
  Alignment alignment;          ///< rigid
  std::vector<double> error_m;  ///< by match
  Statistics statistics;
};

/// Errors of motions.
struct RelativeErrors {
  std::string pairs_rule;  ///< "1 s", "1 frame", "10000 random pairs", for people
  std::vector<RelativeError> errors;
  Statistics translation_m, rotation_deg, full;
};

/// evo_ape or evo_rpe with one kind of alignment.
struct EvoErrors {
  std::optional<Alignment> alignment;  ///< none: as they are
  std::vector<double> translation_m, rotation_deg, full;
};

/// Everything that is measured of an estimate.
struct Evaluation {
  std::size_t truth_poses = 0, estimate_poses = 0;
  std::size_t truth_repeated = 0;  ///< lines of the truth that a later one replaced
  std::optional<FrameCount> frames;
  AbsoluteError ate;
  std::vector<RelativeErrors> rpe;  ///< TUM; a rule that has fewer than two pairs is left out
  std::vector<Match> evo_matches;
  EvoErrors ape, ape_aligned;
  std::optional<EvoErrors> ape_scaled;  ///< none if the scale cannot be determined
  EvoErrors evo_rpe;                    ///< delta of one frame; alignment has no influence on it
  std::optional<EvoErrors> evo_rpe_scaled;

  /// Poses of the estimate per frame of the sequence; none if the number of frames is not known.
  std::optional<double> coverage() const;
};

/// Throws std::runtime_error that says what is the matter where a number would mean nothing: an empty
/// trajectory, no overlap in time, fewer than three matches, more poses than frames.
Evaluation evaluate(const GroundTruth& truth, const Trajectory& estimate,
                    const std::optional<FrameCount>& frames);

}  // namespace sediment::tools
