#include "stages/fuse/frame_selection.hpp"

#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>

namespace sediment::fuse {
namespace {

std::unordered_map<std::string, std::size_t> index_by_stamp(const auto& stamped) {
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < stamped.size(); ++i) index.emplace(stamped[i].stamp, i);
  return index;
}

std::optional<std::size_t> nearest_frame(std::span<const FrameStamp> frames, double stamp_s) {
  std::optional<std::size_t> nearest;
  const auto apart_s = [&](std::size_t i) { return std::abs(frames[i].stamp_s - stamp_s); };
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (apart_s(i) <= kTolerance_s && (!nearest || apart_s(i) < apart_s(*nearest))) nearest = i;
  return nearest;
}

std::set<std::size_t> frames_of_keyframes(std::span<const FrameStamp> frames, const Trajectory& keyframes) {
  const auto frame_by_stamp = index_by_stamp(frames);
  std::set<std::size_t> chosen;
  for (const StampedPose& keyframe : keyframes) {
    if (const auto same = frame_by_stamp.find(keyframe.stamp); same != frame_by_stamp.end())
      chosen.insert(same->second);
    else if (const auto nearest = nearest_frame(frames, keyframe.stamp_s))
      chosen.insert(*nearest);
  }
  return chosen;
}

}  // namespace

Selection select_frames(std::span<const FrameStamp> frames, const Trajectory& trajectory,
                        const Trajectory& keyframes, FrameChoice choice, int every_nth) {
  std::set<std::size_t> chosen;
  if (choice == FrameChoice::keyframes) {
    chosen = frames_of_keyframes(frames, keyframes);
  } else {
    const std::size_t step = choice == FrameChoice::all ? 1 : static_cast<std::size_t>(every_nth);
    for (std::size_t i = 0; i < frames.size(); i += step) chosen.insert(i);
  }

  Selection selection;
  const FramePoses poses(frames, trajectory);
  for (const std::size_t frame_idx : chosen) {
    if (const auto pose = poses.pose_of(frames[frame_idx]))
      selection.frames.push_back({frame_idx, *pose});
    else
      selection.without_pose.push_back(frames[frame_idx].stamp);
  }
  return selection;
}

}  // namespace sediment::fuse
