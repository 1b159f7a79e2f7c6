#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/scene/trajectory.hpp"
#include "stages/project2d/ground_search.hpp"

namespace sediment::project2d {

/// Up as the cameras saw it: people hold a camera upright and look ahead or down, so the mean of the upward
/// image directions is up but for the mean pitch. Throws std::runtime_error if there are no poses or they
/// cancel out.
UpHint up_from_trajectory(const Trajectory& trajectory);

/// Up as an accelerometer felt it: the mean of its readings, turned into the world by the poses at their
/// times. At rest it reads the reaction to gravity, which points up; some files have the opposite sign, so
/// that of `by_posture` decides. None if fewer than ten readings have a pose. The file has TUM's columns
/// (stamp ax ay az), in the camera frame. Throws std::runtime_error with file and line.
std::optional<UpHint> up_from_accelerometer(const std::filesystem::path& file, const Trajectory& trajectory,
                                            const UpHint& by_posture);

/// Reads "x y z", the upward direction in the world frame. Throws std::runtime_error if the text is something
/// else.
UpHint parse_up(const std::string& text);

}  // namespace sediment::project2d
