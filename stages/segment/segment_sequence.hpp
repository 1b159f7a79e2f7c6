#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "stages/segment/mask_source.hpp"

namespace sediment::segment {

/// What was found in a sequence.
struct Counts {
  std::size_t frames = 0, instances = 0;
  std::size_t frames_without_instances = 0, frames_without_person = 0;
  std::map<std::string, std::size_t> instances_per_class;
  std::uint64_t masked_pixels = 0, pixels = 0;
};

/// Masks of the frames 0 .. frames-1, each given to `store` on the thread that made it, in no fixed order.
/// Several frames are in work at once, as many as there are threads, so memory does not grow with the
/// sequence.
Counts segment_sequence(const MaskSource& source, std::size_t frames, int threads,
                        const std::function<void(std::size_t frame_idx, const InstanceMask&)>& store);

}  // namespace sediment::segment
