#pragma once

#include "stages/track/bundle_adjustment.hpp"
#include "stages/track/map.hpp"

namespace sediment::track {

/// Adjusts the keyframe, those that share most landmarks with it, and all landmarks these see; other
/// keyframes that see them stay as they are. Sightings that do not fit afterwards are taken out of the map.
void adjust_around(Map& map, int keyframe_idx, const Pinhole& pinhole);

/// Adjusts every keyframe but the first and every landmark, twice: with outliers held back by the robust
/// loss, then without those that did not fit. Returns the timing of the sensor that fits best, given that the
/// measurements were made with `timing`: a change of it is believed only if it saves a hundredth of the cost.
SensorTiming adjust_all(Map& map, const Pinhole& pinhole, const SensorTiming& timing);

}  // namespace sediment::track
