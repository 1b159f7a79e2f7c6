#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "pipeline/scene/trajectory.hpp"
#include "tools/evaluate-trajectory/evaluation.hpp"

namespace sediment::tools {

/// A table for people.
std::string to_text(const Evaluation& evaluation);

/// All figures: ate.rmse, ate.pairs, rpe.translation.rmse, rpe.rotation_deg.rmse (fixed delta of 1 s),
/// rpe_frame, rpe_random, evo.ape..., coverage, pairs. What could not be computed is null.
nlohmann::ordered_json to_json(const Evaluation& evaluation);

/// One line a matched pose: stamp,truth_stamp,ate_m,rpe_1s_m,rpe_1s_deg; the last two are empty where a pose
/// begins no pair.
std::string to_csv(const Evaluation& evaluation, const Trajectory& truth, const Trajectory& estimate);

}  // namespace sediment::tools
