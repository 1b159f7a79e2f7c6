#pragma once

#include <filesystem>

#include "stages/track/track.hpp"

namespace sediment::track {

/// Both throw std::runtime_error if a file cannot be written.
void write_summary(const std::filesystem::path& file, const Tracked& tracked);
/// Keyframes with their features, at most 40, evenly spread over the recording, as STAMP.png; residuals.png.
void write_diagnostics(const std::filesystem::path& folder, const Recording& recording,
                       const Diagnosis& diagnosis);

}  // namespace sediment::track
