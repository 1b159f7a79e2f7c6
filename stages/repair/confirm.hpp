#pragma once

#include <vector>

#include "stages/repair/clip.hpp"
#include "stages/repair/link.hpp"

namespace sediment::repair {

struct ConfirmParameters {
  int min_detections = 2;  ///< of an object, within `max_gap` frames of each other; 1 trusts everything
  int witnesses = 2;       ///< frames that must contradict a lonely detection before it is dropped
};

/// Decides which detections of a frame are to be trusted. One that has fewer than `min_detections` of its
/// track within `max_gap` frames is false if at least `witnesses` of the two frames before and the two after
/// see at least half of its surface, detect something, and do not detect it. The frames up to frame_idx +
/// max_gap must be linked, or be the last.
void confirm(Clip& clip, std::size_t frame_idx, double depth_scale, int max_gap,
             const ConfirmParameters& parameters, const std::vector<Track>& tracks);

}  // namespace sediment::repair
