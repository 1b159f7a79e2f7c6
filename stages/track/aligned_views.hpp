#pragma once

#include "stages/track/map.hpp"
#include "stages/track/pose_estimation.hpp"

namespace sediment::track {

/// How a frame at about `world_from_camera` lies to the keyframes of its segment that look most like it, by
/// the alignment of their whole images; at most three. Poses must be good already: what is far from them is
/// left out.
std::vector<AlignedView> aligned_views(const Map& map, int segment, const DenseFrame& frame,
                                       const Pose& world_from_camera, const DenseCamera& camera,
                                       double depth_noise);

}  // namespace sediment::track
