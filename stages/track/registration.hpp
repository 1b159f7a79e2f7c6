#pragma once

#include <optional>
#include <vector>

#include "stages/track/pose_estimation.hpp"

namespace sediment::track {

/// The rigid transform that takes `source` onto `target` with least squared distances (Horn 1987, by SVD).
/// At least three points each, not all on a line.
Pose rigid_alignment(const std::vector<Vec3>& source, const std::vector<Vec3>& target);

/// The pose of a camera from correspondences of which many may be wrong: RANSAC over three points with
/// measured depth, counted by reprojection and depth, then estimate_pose. Its draws are a fixed function of
/// the input. None if fewer than `least_inliers` agree.
std::optional<PoseEstimate> find_pose(const std::vector<Correspondence>& correspondences,
                                      const Pinhole& pinhole, int least_inliers);

}  // namespace sediment::track
