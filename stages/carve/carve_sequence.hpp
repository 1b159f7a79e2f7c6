#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/trajectory.hpp"
#include "stages/carve/see_through.hpp"

namespace sediment::carve {

struct Statistics {
  std::size_t views = 0;  ///< frames that were asked
  std::size_t frames_without_pose = 0;
  std::size_t never_seen = 0;  ///< points that no view says anything about; they stay
  std::size_t spared = 0;      ///< points that some view sees through, but not enough of them
};

struct Carved {
  LabelledCloud kept, removed;  ///< both in the order of the cloud
  Statistics statistics;
};

/// Asks every `every_nth` frame of the sequence that has a pose about every point of the cloud. `advance` is
/// called after each one.
Carved carve_cloud(const LabelledCloud& cloud, const Sequence& sequence, const Trajectory& trajectory,
                   const std::optional<DynamicMasksReader>& dynamic, int every_nth,
                   const Parameters& parameters, const std::function<void()>& advance);

}  // namespace sediment::carve
