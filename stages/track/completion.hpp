#pragma once

#include "stages/track/tracker.hpp"

namespace sediment::track {

/// After the last frame: every tracked frame is matched once more with the final map and its pose solved
/// against it, from all landmarks that any keyframe near it in space holds, those of its future too.
void refine_frames(Tracker& tracker, const Pinhole& pinhole);

}  // namespace sediment::track
