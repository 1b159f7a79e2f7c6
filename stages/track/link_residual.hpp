#pragma once

#include <array>

#include "pipeline/scene/pose.hpp"

namespace sediment::track {

/// What two camera poses differ from what was measured between them: rotation vector, then translation. Its
/// derivatives are by the updates of both poses (exp(rotation) on the left of the rotation alone, translation
/// added), row-major 6 x 6, to first order in the error.
struct LinkResidual {
  std::array<double, 6> error{};
  std::array<double, 36> by_from{}, by_to{};
};

LinkResidual link_residual(const Pose& from_camera_from_world, const Pose& to_camera_from_world,
                           const Pose& to_from_from);

}  // namespace sediment::track
