#include "stages/repair/confirm.hpp"

#include <algorithm>

#include "stages/repair/trails.hpp"

namespace sediment::repair {
namespace {

constexpr int kNeighbors = 2;  ///< frames on either side that may bear witness

int detections_near(const Track& track, std::size_t frame_idx, int max_gap) {
  const auto gap = static_cast<std::size_t>(max_gap);
  return static_cast<int>(std::count_if(track.frames.begin(), track.frames.end(), [&](std::size_t frame) {
    return frame + gap >= frame_idx && frame <= frame_idx + gap;
  }));
}

/// For each suspect (index of a detection): how many neighbours on one side contradict it.
void count_witnesses(const Clip& clip, const ClipFrame& frame, const std::vector<std::size_t>& suspects,
                     Direction direction, double depth_scale, std::vector<int>& against) {
  const PixelTrails here = start_trails(frame.depth, kStep_px);
  walk(clip, frame.frame_idx, direction, kNeighbors, kStep_px, depth_scale,
       [&](const ClipFrame& neighbor, const PixelTrails& there) {
         if (neighbor.detections.instances.empty()) return true;
         for (std::size_t s = 0; s < suspects.size(); ++s) {
           const int id = frame.detections.instances[suspects[s]].id;
           int all = 0, seen = 0;
           for (std::size_t i = 0; i < here.size(); ++i) {
             if (here.nearest<std::uint16_t>(frame.detections.ids, i) != id) continue;
             ++all;
             seen += there.valid[i];
           }
           against[s] += 2 * seen >= all;
         }
         return true;
       });
}

}  // namespace

void confirm(Clip& clip, std::size_t frame_idx, double depth_scale, int max_gap,
             const ConfirmParameters& parameters, const std::vector<Track>& tracks) {
  ClipFrame& frame = clip.at(frame_idx);
  frame.trusted.assign(frame.track_of.size(), true);
  std::vector<std::size_t> suspects;
  for (std::size_t i = 0; i < frame.track_of.size(); ++i)
    if (detections_near(tracks[static_cast<std::size_t>(frame.track_of[i])], frame_idx, max_gap) <
        parameters.min_detections)
      suspects.push_back(i);
  if (suspects.empty()) return;

  std::vector<int> against(suspects.size());
  count_witnesses(clip, frame, suspects, Direction::backward, depth_scale, against);
  count_witnesses(clip, frame, suspects, Direction::forward, depth_scale, against);
  for (std::size_t s = 0; s < suspects.size(); ++s)
    frame.trusted[suspects[s]] = against[s] < parameters.witnesses;
}

}  // namespace sediment::repair
