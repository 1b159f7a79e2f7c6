#include "stages/fuse/frame_selection.hpp"

#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>

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

/// Poses and frames, joined by stamp and by time.
class PoseFinder {
 public:
  PoseFinder(std::span<const FrameStamp> frames, const Trajectory& trajectory)
      : trajectory_(trajectory), pose_by_stamp_(index_by_stamp(trajectory)) {
    for (const FrameStamp& frame : frames) stamps_.insert(frame.stamp);
  }

  std::optional<Pose> pose_of(const FrameStamp& frame) const {
    if (const auto same = pose_by_stamp_.find(frame.stamp); same != pose_by_stamp_.end())
      return trajectory_[same->second].world_from_camera;
    if (const auto between = pose_at(trajectory_, frame.stamp_s, kLongestGap_s)) return between;
    const auto nearest = nearest_pose(trajectory_, frame.stamp_s, kTolerance_s);
    if (nearest && !stamps_.contains(trajectory_[*nearest].stamp))
      return trajectory_[*nearest].world_from_camera;
    return std::nullopt;
  }

 private:
  const Trajectory& trajectory_;
  std::unordered_map<std::string, std::size_t> pose_by_stamp_;
  std::unordered_set<std::string> stamps_;
};

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
  const PoseFinder finder(frames, trajectory);
  for (const std::size_t frame_idx : chosen) {
    if (const auto pose = finder.pose_of(frames[frame_idx]))
      selection.frames.push_back({frame_idx, *pose});
    else
      selection.without_pose.push_back(frames[frame_idx].stamp);
  }
  return selection;
}

}  // namespace sediment::fuse
