#pragma once

#include <optional>
#include <vector>

#include "pipeline/scene/pose.hpp"

namespace sediment::tools {

/// The transform that brings an estimate onto the truth: truth = scale * R * estimate + t.
struct Alignment {
  Pose truth_from_estimate;
  double scale = 1;

  Vec3 operator*(Vec3 point) const {
    return scale * truth_from_estimate.rotate(point) + truth_from_estimate.translation;
  }
  /// The pose in the frame of the truth; its rotation stays one.
  Pose operator*(const Pose& pose) const;
};

/// Least squares over matched positions, by singular value decomposition. Source: Horn 1987 as in TUM's
/// evaluate_ate.py; with scale Umeyama 1991 as in evo. None with scale if the estimate does not move at all.
std::optional<Alignment> align(const std::vector<Vec3>& truth, const std::vector<Vec3>& estimate,
                               bool with_scale);

}  // namespace sediment::tools
