#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/trajectory.hpp"
#include "stages/octree/ray_map.hpp"

namespace sediment::octree {

struct CastCounts {
  std::size_t frames = 0, frames_without_pose = 0;
};

/// Casts the rays of every `every_nth` frame that has a pose into `map`, in the order of the frames; at most
/// `frames_in_flight` are in memory at a time. `advance` is called after each one. Throws std::runtime_error
/// that names the frame, and if no frame has a pose.
CastCounts cast_sequence(const Sequence& sequence, const Trajectory& trajectory,
                         const std::optional<DynamicMasksReader>& dynamic, int every_nth,
                         const RayParameters& parameters, double resolution_m, std::size_t frames_in_flight,
                         const std::function<void()>& advance, RayMap& map);

}  // namespace sediment::octree
