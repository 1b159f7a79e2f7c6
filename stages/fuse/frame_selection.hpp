#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "pipeline/scene/trajectory.hpp"

namespace sediment::fuse {

/// Which frames go into the map.
enum class FrameChoice { keyframes, all, every_nth };

/// Time stamp of a frame: as written, and in seconds.
struct FrameStamp {
  std::string stamp;
  double stamp_s = 0;
};

/// A selected frame and where its camera was.
struct PosedFrame {
  std::size_t frame_idx = 0;
  Pose world_from_camera;
};

struct Selection {
  std::vector<PosedFrame> frames;         ///< ascending
  std::vector<std::string> without_pose;  ///< stamps of selected frames that have no pose
};

/// The longest gap between two poses that is bridged, and how far away a single pose may be (TUM's
/// tolerance).
inline constexpr double kLongestGap_s = 0.04, kTolerance_s = 0.02;

/// Chooses frames and finds their poses. A frame's pose is
/// 1. the one with the frame's stamp, letter by letter;
/// 2. else interpolated between the poses before and after, if these are at most kLongestGap_s apart;
/// 3. else the nearest within kTolerance_s that is not, by its stamp, the pose of another frame.
/// So a frame that tracking lost never gets its neighbour's pose, and a trajectory made by other means
/// (motion capture, stamps rounded or of the depth images) still fits.
///
/// Each keyframe chooses the frame with its stamp, else the nearest within kTolerance_s; `keyframes` is used
/// for FrameChoice::keyframes only. `every_nth` counts from the first frame.
Selection select_frames(std::span<const FrameStamp> frames, const Trajectory& trajectory,
                        const Trajectory& keyframes, FrameChoice choice, int every_nth);

}  // namespace sediment::fuse
