#pragma once

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "stages/track/track.hpp"

namespace sediment::track {

/// A sequence and its dynamic masks (or null) as tracking takes them; frames are read when asked for. Both
/// must outlive the recording.
Recording recording_of(const Sequence& sequence, const DynamicMasksReader* masks);

}  // namespace sediment::track
