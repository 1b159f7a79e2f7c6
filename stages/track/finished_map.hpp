#pragma once

#include "stages/track/track.hpp"
#include "stages/track/tracker.hpp"

namespace sediment::track {

/// What was found out about a recording on the way to its final map.
struct FinishedMap {
  SensorTiming timing;
  int still_landmarks = 0;  ///< on dynamic pixels
};

/// After the front end and its loops: adjusts the map of at least two keyframes as a whole, finds the timing
/// of the sensor, measures all features again with it, and lets in what holds still on dynamic pixels.
FinishedMap finish_map(const Recording& recording, const Parameters& parameters, const Pinhole& pinhole,
                       Tracker& tracker);

}  // namespace sediment::track
