#include "stages/track/collection.hpp"

#include <algorithm>
#include <iterator>
#include <map>

namespace sediment::track {
namespace {

int segment_of(const TrackedFrame& frame, const Map& map) {
  return map.keyframes[frame.reference_idx].segment;
}

/// Numbers of the segments: 0 the one with most frames, the others in order of time.
std::map<int, int> numbered_segments(const Tracker& tracker) {
  std::map<int, int> frames_of, numbers;
  for (const TrackedFrame& frame : tracker.frames())
    if (frame.tracked) ++frames_of[segment_of(frame, tracker.map())];
  const auto largest = std::max_element(frames_of.begin(), frames_of.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  int next = 1;
  for (auto it = frames_of.begin(); it != frames_of.end(); ++it)
    numbers[it->first] = it == largest ? 0 : next++;
  return numbers;
}

}  // namespace

Tracked collect(const Recording& recording, const Tracker& tracker, Mode mode) {
  Tracked result;
  const std::map<int, int> numbers = numbered_segments(tracker);
  std::vector<Trajectory> worlds(std::max<std::size_t>(numbers.size(), 1));
  std::vector<Pose> world_from_map(worlds.size());
  for (std::size_t i = 0; i < tracker.frames().size(); ++i) {
    const TrackedFrame& frame = tracker.frames()[i];
    FrameTracking entry;
    entry.stamp = recording.stamps[i];
    if (frame.tracked) {
      entry.segment = numbers.at(segment_of(frame, tracker.map()));
      const auto world = static_cast<std::size_t>(entry.segment);
      const Pose pose = mode == Mode::causal ? frame.world_from_camera_then
                                             : camera_from_world(frame, tracker.map()).inverse();
      if (worlds[world].empty()) world_from_map[world] = pose.inverse();
      worlds[world].push_back({recording.stamps[i], recording.stamps_s[i], world_from_map[world] * pose});
    }
    if (entry.segment == 0) {
      entry.state = TrackingState::tracked;
      entry.keyframe = frame.keyframe;
      entry.matches = frame.matches;
      entry.inliers = frame.inliers;
      entry.residual_px = frame.residual_px;
    }
    result.frames.push_back(std::move(entry));
  }
  result.segments = static_cast<int>(numbers.size());
  result.poses = std::move(worlds.front());
  result.apart.assign(std::make_move_iterator(worlds.begin() + 1), std::make_move_iterator(worlds.end()));
  for (const MapPoint& point : tracker.map().points) result.landmarks += !point.removed;
  return result;
}

}  // namespace sediment::track
