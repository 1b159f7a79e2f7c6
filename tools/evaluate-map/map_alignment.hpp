#pragma once

#include "pipeline/scene/trajectory.hpp"
#include "tools/truth/true_sequence.hpp"

namespace sediment::tools {

/// The rigid motion from the world of a map to that of the truth, from the trajectory the map was made with:
/// least squares over points 2 m in front of the cameras (the corners of the view and its middle), where the
/// map is, so that it is determined even if the camera hardly moves. Throws std::runtime_error if no pose of
/// the trajectory (by stamp) has a true one.
Pose truth_from_map(const TrueSequence& truth, const Trajectory& trajectory);

}  // namespace sediment::tools
