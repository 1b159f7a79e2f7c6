#pragma once

#include <filesystem>

#include "stages/track/track.hpp"

namespace sediment::track {

/// All throw std::runtime_error if a file cannot be written.
void write_summary(const std::filesystem::path& file, const Tracked& tracked);
/// N.txt: the poses of each part that could not be joined to the trajectory, from 1 on.
void write_segments(const std::filesystem::path& folder, const std::vector<Trajectory>& apart);
/// Keyframes with their features, at most 40, evenly spread over the recording, as STAMP.png; residuals.png.
void write_diagnostics(const std::filesystem::path& folder, const Recording& recording,
                       const Diagnosis& diagnosis);

}  // namespace sediment::track
