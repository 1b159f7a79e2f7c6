#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/scene/trajectory.hpp"

namespace sediment {

/// Reads a trajectory in TUM format: `timestamp tx ty tz qx qy qz qw`, camera to world, blanks or commas
/// between,
/// `#` comments. Sorted by time. Throws std::runtime_error with file and line: wrong number of columns, NaN,
/// a zero quaternion, a stamp twice.
Trajectory read_tum_trajectory(const std::filesystem::path& file);

/// Writes it: the stamp as it is, positions and quaternions with 9 decimals.
void write_tum_trajectory(const std::filesystem::path& file, const Trajectory& trajectory);

/// Writes the `trajectory` artifact: trajectory.txt, keyframes.txt, tracking.json (one entry a frame of the
/// sequence).
void write_trajectory(const std::filesystem::path& folder, const Trajectory& trajectory,
                      const std::vector<FrameTracking>& frames);

/// Reads the `trajectory` artifact: every pose. Throws as read_tum_trajectory.
Trajectory read_trajectory(const std::filesystem::path& folder);
/// Only the keyframes.
Trajectory read_keyframes(const std::filesystem::path& folder);

}  // namespace sediment
