#pragma once

#include <functional>

#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/labels.hpp"
#include "stages/repair/confirm.hpp"
#include "stages/repair/snap.hpp"
#include "stages/repair/vote.hpp"

namespace sediment::repair {

struct Parameters {
  VoteParameters vote;  ///< its max_gap holds for linking and confirming too
  ConfirmParameters confirm;
  SnapParameters snap;
  bool speeds = true;             ///< whether to measure them
  double longest_pause_s = 0.25;  ///< frames further apart in time know nothing of each other
};

struct Counts {
  std::size_t frames = 0;
  std::size_t detections = 0;
  std::size_t detections_dropped = 0;     ///< false ones
  std::size_t classes_corrected = 0;      ///< detections whose object mostly was of another class
  std::size_t instances_repaired = 0;     ///< in frames where the network had missed them
  std::size_t objects = 0;                ///< with a mask somewhere
  std::size_t frames_without_speeds = 0;  ///< no motion of the camera could be fitted, or no next frame
};

/// Repairs the masks of a sequence and hands them to the writer (which is finished here). Works in parallel
/// on a window of the sequence: memory does not grow with its length, and the result does not depend on the
/// threads. `labels` say which classes move by themselves. `on_frame` is called after each frame. Throws
/// std::runtime_error that names the frame.
Counts repair_sequence(const Sequence& sequence, const MasksReader& masks, const LabelTable& labels,
                       const Parameters& parameters, MasksWriter& writer,
                       const std::function<void()>& on_frame);

}  // namespace sediment::repair
