#pragma once

#include "stages/track/tracker.hpp"

namespace sediment::track {

// Who sits still is masked, but shows where the camera is as well as the chair does. Features on dynamic
// pixels wait until the map is finished without them, and then serve where they hold still.

/// Puts the waiting features of every tracked frame behind its features. Returns how many features of each
/// keyframe were there before.
std::vector<std::size_t> join_waiting_features(Tracker& tracker);

/// Makes landmarks of the features behind the first `trusted` of each keyframe. They stay in the map if other
/// keyframes find them in the same place: three at least, and a third of those that should see them. Poses
/// must be good already; adjust the map afterwards. Returns the number of landmarks let in.
int admit_still_features(Map& map, const std::vector<std::size_t>& trusted, const Pinhole& pinhole);

}  // namespace sediment::track
