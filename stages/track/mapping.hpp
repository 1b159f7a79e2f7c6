#pragma once

#include "stages/track/map.hpp"
#include "stages/track/matching.hpp"
#include "stages/track/pinhole.hpp"

namespace sediment::track {

/// Makes a keyframe of a frame whose features show the landmarks in `matches`: connects these, makes new
/// landmarks of the other features with depth, joins landmarks that it and its neighbours hold twice, drops
/// recent landmarks that are seldom found again, and adjusts the neighbourhood. Returns the keyframe's index.
int add_keyframe(Map& map, int frame_idx, const Pose& world_from_camera,
                 std::shared_ptr<const FrameFeatures> features, const std::vector<Match>& matches,
                 double noise_scale, const Pinhole& pinhole);

/// Finds landmarks in a keyframe that does not have them yet: joins them with the landmark its feature shows
/// already, or lets it see them.
void fuse_into(Map& map, int keyframe_idx, const std::vector<int>& point_ids, const Pinhole& pinhole);

/// The landmarks of these keyframes, each once, in ascending order.
std::vector<int> points_of(const Map& map, const std::vector<int>& keyframes);

}  // namespace sediment::track
