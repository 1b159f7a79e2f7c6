#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/scene/frame.hpp"

namespace sediment::synthetic {

/// How a poor network differs from the truth.
struct Degradation {
  double missed_share = 0.3;  ///< of the frames have no detection at all
  int longest_run = 10;       ///< frames missed in a row
  int boundary_px = 6;        ///< each mask is eroded or dilated by up to this
  double wrong_class_share = 0.05;
};

/// For each frame whether nothing is detected in it: runs of 1 .. longest_run frames, at least one frame
/// apart.
std::vector<bool> missed_frames(std::size_t frame_count, const Degradation& degradation, std::uint64_t seed);

/// The detections of a frame as a poor network would give them: every instance is grown or shrunk, a later
/// one covers an earlier one, some have another class; scores are 0.35 .. 0.95. Ids stay. What shrinks to
/// nothing is left out. Depends on `seed` and `frame_idx`, not on other frames.
InstanceMask degraded(const InstanceMask& truth, const Degradation& degradation, std::uint64_t seed,
                      std::size_t frame_idx);

}  // namespace sediment::synthetic
