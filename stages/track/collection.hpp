#pragma once

#include "stages/track/track.hpp"
#include "stages/track/tracker.hpp"

namespace sediment::track {

/// The poses that tracking has of a recording's frames, with Mode::offline as the map is now. The segment
/// with most frames is the trajectory; where the others are in its world nobody knows, so each has one of its
/// own. A world is the camera of its first frame.
Tracked collect(const Recording& recording, const Tracker& tracker, Mode mode);

}  // namespace sediment::track
