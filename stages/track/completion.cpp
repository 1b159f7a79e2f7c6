#include "stages/track/completion.hpp"

#include <tbb/parallel_for.h>

#include "stages/track/mapping.hpp"

namespace sediment::track {
namespace {

constexpr int kLeastShared = 15, kNeighbours = 20, kLeastToAccept = 20;

void refine(TrackedFrame& frame, const Map& map, const Pinhole& pinhole) {
  std::vector<int> keyframes{frame.reference_idx};
  for (const auto& [shared, other] : map.covisible(frame.reference_idx, kLeastShared))
    if (static_cast<int>(keyframes.size()) < kNeighbours) keyframes.push_back(other);
  const Pose start = camera_from_world(frame, map);
  const auto targets = visible_targets(map, points_of(map, keyframes), pinhole, start);
  const std::vector<char> none_taken(frame.features->size(), 0);
  const auto matches = match_targets(targets, *frame.features, none_taken, pinhole, {4, 80, 0.9});
  std::vector<Correspondence> correspondences;
  for (const Match& match : matches)
    correspondences.push_back({map.points[match.point_id].position,
                               measurement_of(frame.features->feature(match.feature_idx), pinhole)});
  const PoseEstimate estimate = estimate_pose(correspondences, pinhole, start);
  if (estimate.inliers < kLeastToAccept || estimate.inliers < frame.inliers / 2) return;
  frame.camera_from_reference =
      estimate.camera_from_world * map.keyframes[frame.reference_idx].world_from_camera;
  frame.matches = static_cast<int>(matches.size());
  frame.inliers = estimate.inliers;
  frame.residual_px = estimate.residual_px;
}

}  // namespace

void refine_frames(Tracker& tracker, const Pinhole& pinhole) {
  auto& frames = tracker.frames();
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
    if (frames[i].tracked && !frames[i].keyframe) refine(frames[i], tracker.map(), pinhole);
  });
}

}  // namespace sediment::track
