#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "pipeline/scene/frame_poses.hpp"

namespace sediment::fuse {

/// Which frames go into the map.
enum class FrameChoice { keyframes, all, every_nth };

/// A selected frame and where its camera was.
struct PosedFrame {
  std::size_t frame_idx = 0;
  Pose world_from_camera;
};

struct Selection {
  std::vector<PosedFrame> frames;         ///< ascending
  std::vector<std::string> without_pose;  ///< stamps of selected frames that have no pose
};

/// Chooses frames and finds their poses (FramePoses).
///
/// Each keyframe chooses the frame with its stamp, else the nearest within kTolerance_s; `keyframes` is used
/// for FrameChoice::keyframes only. `every_nth` counts from the first frame.
Selection select_frames(std::span<const FrameStamp> frames, const Trajectory& trajectory,
                        const Trajectory& keyframes, FrameChoice choice, int every_nth);

}  // namespace sediment::fuse
