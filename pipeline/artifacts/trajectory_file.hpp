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

/// Poses of a motion capture system.
struct GroundTruth {
  Trajectory trajectory;
  std::size_t repeated = 0;  ///< lines that were left out because a later one has the same stamp
};

/// Reads a ground truth as read_tum_trajectory, but for stamps that are given twice: the benchmark's own
/// walking_static has one. If both poses agree to 1 cm and 1 degree the last one counts, as in TUM's tools;
/// else it is an error.
GroundTruth read_ground_truth(const std::filesystem::path& file);

/// Writes it: the stamp as it is, positions and quaternions with 9 decimals.
void write_tum_trajectory(const std::filesystem::path& file, const Trajectory& trajectory);

/// Writes the `trajectory` artifact: trajectory.txt, keyframes.txt, tracking.json (one entry a frame of the
/// sequence).
void write_trajectory(const std::filesystem::path& folder, const Trajectory& trajectory,
                      const std::vector<FrameTracking>& frames);

/// Reads the `trajectory` artifact: every pose. Throws as read_tum_trajectory.
Trajectory read_trajectory(const std::filesystem::path& folder);
/// What tracking says of every frame of the sequence. Throws std::runtime_error that names file and frame.
std::vector<FrameTracking> read_tracking(const std::filesystem::path& folder);
/// Only the keyframes.
Trajectory read_keyframes(const std::filesystem::path& folder);

}  // namespace sediment
