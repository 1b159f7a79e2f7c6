#pragma once

#include <optional>
#include <string>

#include "pipeline/scene/trajectory.hpp"
#include "stages/project2d/ground_search.hpp"

namespace sediment::project2d {

/// Up as the cameras saw it: people hold a camera upright and look ahead or down, so the mean of the upward
/// image directions is up but for the mean pitch. Throws std::runtime_error if there are no poses or they
/// cancel out.
UpHint up_from_trajectory(const Trajectory& trajectory);

/// Reads "x y z", the upward direction in the world frame. Throws std::runtime_error if the text is something
/// else.
UpHint parse_up(const std::string& text);

}  // namespace sediment::project2d
