#pragma once

#include "stages/track/tracker.hpp"

namespace sediment::track {

/// After the last frame: frames that the front end lost are looked for in the final map, which knows places
/// that the camera came to later.
void find_lost_frames(Tracker& tracker, const Pinhole& pinhole);

/// Every keyframe is matched once more with the landmarks of its neighbours.
void match_again(Map& map, const Pinhole& pinhole);

/// After the last frame: every tracked frame is matched once more with the final map and its pose solved
/// against it, from all landmarks that any keyframe near it in space holds, those of its future too. Where
/// these are few, how its whole image lies to those of keyframes counts beside them.
void refine_frames(Tracker& tracker, const Pinhole& pinhole, const DenseCamera& dense_camera,
                   double depth_noise);

/// After the last frame: takes out what only noise can be in the motion of the camera, from frame to frame.
/// The map stays as it is.
void smooth_frames(Tracker& tracker);

}  // namespace sediment::track
