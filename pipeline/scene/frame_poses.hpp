#pragma once

#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "pipeline/scene/trajectory.hpp"

namespace sediment {

/// Time stamp of a frame: as written, and in seconds.
struct FrameStamp {
  std::string stamp;
  double stamp_s = 0;
};

/// The longest gap between two poses that is bridged, and how far away a single pose may be (TUM's
/// tolerance).
inline constexpr double kLongestGap_s = 0.04, kTolerance_s = 0.02;

/// Where the camera was in each frame of a sequence. A frame's pose is
/// 1. the one with the frame's stamp, letter by letter;
/// 2. else interpolated between the poses before and after, if these are at most kLongestGap_s apart;
/// 3. else the nearest within kTolerance_s that is not, by its stamp, the pose of another frame.
/// So a frame that tracking lost never gets its neighbour's pose, and a trajectory made by other means
/// (motion capture, stamps rounded or of the depth images) still fits.
class FramePoses {
 public:
  /// `trajectory` must live as long as this.
  FramePoses(std::span<const FrameStamp> frames, const Trajectory& trajectory);

  std::optional<Pose> pose_of(const FrameStamp& frame) const;

 private:
  const Trajectory& trajectory_;
  std::unordered_map<std::string, std::size_t> pose_by_stamp_;
  std::unordered_set<std::string> stamps_;
};

}  // namespace sediment
