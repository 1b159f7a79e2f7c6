#pragma once

#include <string>

#include "stages/track/track.hpp"
#include "stages/track/tracker.hpp"

namespace sediment::track {

/// How well the landmarks fit the keyframes, after the last adjustment.
Diagnosis diagnose(const Map& map, const Pinhole& pinhole);

/// What a person wants to know of a tracked recording, in lines of text: coverage and where it was lost, the
/// map, the fit, the weakest frames.
std::string summary_of(const Tracked& tracked);

}  // namespace sediment::track
