#pragma once

#include <functional>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/trajectory.hpp"
#include "stages/movers/regions.hpp"

namespace sediment::movers {

struct Parameters {
  ContradictionParameters contradiction;
  RegionParameters regions;
  double reach_s = 3;      ///< views at most this far in time are compared
  int views = 24;          ///< references within that time, on both sides together
  int min_witnesses = 2;   ///< of the two frames before and the two after, that show a region too; 0: none
  std::size_t margin = 3;  ///< frames before and after in which what has been found is masked where it is
};

struct Counts {
  std::size_t frames_without_pose = 0;  ///< their masks pass through
  std::size_t frames_with_movers = 0;
  std::size_t references = 0;
  std::uint64_t pixels_added = 0;
};

/// Adds to the dynamic masks of a sequence what other frames see through, as kNonPriorDynamic, and hands them
/// to the writer (which is finished here). Frames in parallel; memory holds the references within `reach_s`
/// and a batch of frames, however long the sequence is. Throws std::runtime_error that names the frame.
Counts find_movers(const Sequence& sequence, const DynamicMasksReader& dynamic, const Trajectory& trajectory,
                   const Parameters& parameters, DynamicMasksWriter& writer,
                   const std::function<void()>& on_frame);

}  // namespace sediment::movers
