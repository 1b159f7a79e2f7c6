// The frames of a sequence with poses, speeds and dynamic masks.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/scene/frame_poses.hpp"
#include "stages/movers/contradiction.hpp"

namespace sediment::movers {

class SequenceViews {
 public:
  /// Sequence and masks must outlive the views.
  SequenceViews(const Sequence& sequence, const DynamicMasksReader& dynamic, const Trajectory& trajectory);

  const std::string& stamp(std::size_t frame_idx) const { return stamps_[frame_idx].stamp; }
  double stamp_s(std::size_t frame_idx) const { return stamps_[frame_idx].stamp_s; }
  double apart_s(std::size_t a, std::size_t b) const { return std::abs(stamp_s(a) - stamp_s(b)); }
  bool has_pose(std::size_t frame_idx) const { return poses_.pose_of(stamps_[frame_idx]).has_value(); }

  /// A frame without mask has nothing dynamic. Throws std::runtime_error that names the frame whose mask has
  /// another size than its depth image.
  View read(std::size_t frame_idx) const;

 private:
  Speed speed_of(std::size_t frame_idx) const;

  const Sequence& sequence_;
  const DynamicMasksReader& dynamic_;
  std::vector<FrameStamp> stamps_;
  FramePoses poses_;
};

}  // namespace sediment::movers
