#include "stages/track/completion.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "stages/track/aligned_views.hpp"
#include "stages/track/place_finding.hpp"
#include "stages/track/smoothing.hpp"

namespace sediment::track {
namespace {

constexpr int kNeighbours = 20, kLeastToAccept = 20;
constexpr int kFewLandmarks = 150;  // below, a frame is held badly by them

void refine(TrackedFrame& frame, const Map& map, const Pinhole& pinhole, const DenseCamera& dense_camera,
            double depth_noise) {
  const Pose start = camera_from_world(frame, map);
  const auto keyframes = neighbourhood(map, frame.reference_idx, kNeighbours);
  const auto targets = visible_targets(map, points_of(map, keyframes), pinhole, start);
  const std::vector<char> none_taken(frame.features->size(), 0);
  const auto matches = match_targets(targets, *frame.features, none_taken, pinhole, {4, 80, 0.9});
  PoseEstimate estimate = solve_pose(map, matches, *frame.features, pinhole, start).estimate;
  std::vector<AlignedView> views;
  if (estimate.inliers < kFewLandmarks && frame.dense && !frame.keyframe) {
    const Pose& trusted = estimate.inliers >= kLeastToAccept ? estimate.camera_from_world : start;
    views = aligned_views(map, map.keyframes[frame.reference_idx].segment, *frame.dense, trusted.inverse(),
                          dense_camera, depth_noise);
    if (!views.empty())
      estimate = solve_pose(map, matches, *frame.features, pinhole, trusted, views).estimate;
  }
  const bool held = estimate.inliers >= kLeastToAccept && estimate.inliers >= frame.inliers / 2;
  if (!held && views.empty()) return;
  frame.deviation_rad = estimate.deviation_rad;
  frame.deviation_m = estimate.deviation_m;
  if (frame.keyframe) return;  // has its pose from the adjustment of the map
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

void refine_frames(Tracker& tracker, const Pinhole& pinhole, const DenseCamera& dense_camera,
                   double depth_noise) {
  auto& frames = tracker.frames();
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
    if (frames[i].tracked) refine(frames[i], tracker.map(), pinhole, dense_camera, depth_noise);
  });
}

void smooth_frames(Tracker& tracker) {
  constexpr double kLongestStep_s = 0.25;  // how a hand moves cannot be told over more
  const Map& map = tracker.map();
  std::vector<std::vector<TrackedFrame*>> stretches;
  for (TrackedFrame& frame : tracker.frames()) {
    if (!frame.tracked || frame.deviation_m <= 0) continue;
    const auto follows = [&](const TrackedFrame& last) {
      return frame.stamp_s - last.stamp_s <= kLongestStep_s &&
             map.keyframes[frame.reference_idx].segment == map.keyframes[last.reference_idx].segment;
    };
    if (stretches.empty() || !follows(*stretches.back().back())) stretches.emplace_back();
    stretches.back().push_back(&frame);
  }
  for (const auto& frames : stretches) {
    std::vector<MeasuredPose> measured;
    for (const TrackedFrame* frame : frames)
      measured.push_back({frame->stamp_s, camera_from_world(*frame, map).inverse(), frame->deviation_rad,
                          frame->deviation_m});
    const std::vector<Pose> poses = smoothed(measured);
    for (std::size_t i = 0; i < frames.size(); ++i)
      frames[i]->camera_from_reference =
          poses[i].inverse() * map.keyframes[frames[i]->reference_idx].world_from_camera;
  }
}

}  // namespace sediment::track
