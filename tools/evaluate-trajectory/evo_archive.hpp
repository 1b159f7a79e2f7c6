#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/evaluate-trajectory/evaluation.hpp"

namespace sediment::tools {

/// A result archive that evo's evo_res and evo_fig open: info.json, stats.json, error_array.npy,
/// seconds_from_start.npy, timestamps.npy and both trajectories in TUM format.
void write_evo_ape(const std::filesystem::path& zip, const Evaluation& evaluation, const Trajectory& truth,
                   const Trajectory& estimate, const std::string& truth_name,
                   const std::string& estimate_name);

/// The same of the relative error over one frame.
void write_evo_rpe(const std::filesystem::path& zip, const Evaluation& evaluation, const Trajectory& truth,
                   const Trajectory& estimate, const std::string& truth_name,
                   const std::string& estimate_name);

}  // namespace sediment::tools
