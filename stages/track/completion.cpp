#include "stages/track/completion.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "stages/track/place_finding.hpp"

namespace sediment::track {
namespace {

constexpr int kNeighbours = 20, kLeastToAccept = 20;

void refine(TrackedFrame& frame, const Map& map, const Pinhole& pinhole) {
  const Pose start = camera_from_world(frame, map);
  const auto keyframes = neighbourhood(map, frame.reference_idx, kNeighbours);
  const auto targets = visible_targets(map, points_of(map, keyframes), pinhole, start);
  const std::vector<char> none_taken(frame.features->size(), 0);
  const auto matches = match_targets(targets, *frame.features, none_taken, pinhole, {4, 80, 0.9});
  const PoseEstimate estimate = solve_pose(map, matches, *frame.features, pinhole, start).estimate;
  if (estimate.inliers < kLeastToAccept || estimate.inliers < frame.inliers / 2) return;
  frame.camera_from_reference =
      estimate.camera_from_world * map.keyframes[frame.reference_idx].world_from_camera;
  frame.matches = static_cast<int>(matches.size());
  frame.inliers = estimate.inliers;
  frame.residual_px = estimate.residual_px;
}

// The keyframes that look most like the frame, and those of the frames around it in time.
std::vector<int> places_like(const Tracker& tracker, const PlaceIndex& places, std::size_t frame_idx) {
  constexpr int kMost = 3;
  const auto& frames = tracker.frames();
  std::vector<int> keyframes;
  for (std::size_t i = frame_idx; i-- > 0 && keyframes.empty();)
    if (frames[i].tracked) keyframes.push_back(frames[i].reference_idx);
  for (std::size_t i = frame_idx + 1; i < frames.size(); ++i)
    if (frames[i].tracked) {
      keyframes.push_back(frames[i].reference_idx);
      break;
    }
  const auto similar = places.similar(*frames[frame_idx].features->descriptors());
  for (std::size_t i = 0; i < similar.size() && i < kMost; ++i) keyframes.push_back(similar[i].place_idx);
  return keyframes;
}

}  // namespace

void find_lost_frames(Tracker& tracker, const Pinhole& pinhole) {
  const auto& frames = tracker.frames();
  const Map& map = tracker.map();
  if (map.keyframes.empty() ||
      std::all_of(frames.begin(), frames.end(), [](const auto& f) { return f.tracked; }))
    return;
  const PlaceIndex places = index_of(map);
  std::vector<TrackedFrame> found(frames.begin(), frames.end());
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    TrackedFrame& frame = found[i];
    if (frame.tracked || static_cast<int>(frame.features->size()) < kLeastToAccept) return;
    for (const int keyframe_idx : places_like(tracker, places, i)) {
      const auto located = locate(map, keyframe_idx, *frame.features, pinhole, kLeastToAccept);
      if (!located) continue;
      frame.reference_idx = keyframe_idx;
      frame.camera_from_reference =
          located->estimate.camera_from_world * map.keyframes[keyframe_idx].world_from_camera;
      frame.tracked = true;
      frame.matches = located->tried;
      frame.inliers = located->estimate.inliers;
      frame.residual_px = located->estimate.residual_px;
      return;
    }
  });
  tracker.frames() = std::move(found);
}

void match_again(Map& map, const Pinhole& pinhole) {
  for (int i = 0; i < static_cast<int>(map.keyframes.size()); ++i)
    fuse_into(map, i, points_of(map, neighbourhood(map, i, kNeighbours)), pinhole);
}

void refine_frames(Tracker& tracker, const Pinhole& pinhole) {
  auto& frames = tracker.frames();
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
    if (frames[i].tracked && !frames[i].keyframe) refine(frames[i], tracker.map(), pinhole);
  });
}

}  // namespace sediment::track
