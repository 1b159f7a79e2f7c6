#pragma once

#include <optional>

#include "stages/track/mapping.hpp"
#include "stages/track/place_index.hpp"
#include "stages/track/pose_estimation.hpp"

namespace sediment::track {

/// A pose of a frame against the map, and what it rests on.
struct Located {
  PoseEstimate estimate;
  std::vector<Match> matches;  ///< inliers only
  int tried = 0;
};

/// The pose that fits these matches, and `views` of whole images, from a start nearby.
Located solve_pose(const Map& map, const std::vector<Match>& matches, const FrameFeatures& features,
                   const Pinhole& pinhole, const Pose& camera_from_world_start,
                   std::span<const AlignedView> views = {});

/// The pose of a frame from its descriptors alone, against the landmarks of one keyframe; none if fewer than
/// `least_inliers` agree on one.
std::optional<Located> locate(const Map& map, int keyframe_idx, const FrameFeatures& features,
                              const Pinhole& pinhole, int least_inliers);

/// The same pose from all landmarks of these keyframes. `visible`: how many of them should have been seen.
struct Widened {
  Located located;
  int visible = 0;
};
Widened widen(const Map& map, const std::vector<int>& keyframes, const FrameFeatures& features,
              const Pinhole& pinhole, const Pose& camera_from_world);

/// A keyframe and those that share most landmarks with it.
std::vector<int> neighbourhood(const Map& map, int keyframe_idx, int most);

/// The index of all keyframes as places.
PlaceIndex index_of(const Map& map);

}  // namespace sediment::track
