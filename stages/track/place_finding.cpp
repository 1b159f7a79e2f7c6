#include "stages/track/place_finding.hpp"

#include "stages/track/registration.hpp"

namespace sediment::track {

Located solve_pose(const Map& map, const std::vector<Match>& matches, const FrameFeatures& features,
                   const Pinhole& pinhole, const Pose& start, std::span<const AlignedView> views) {
  std::vector<Correspondence> correspondences;
  for (const Match& match : matches)
    correspondences.push_back(
        {map.points[match.point_id].position, measurement_of(features.feature(match.feature_idx), pinhole)});
  Located located{
      estimate_pose(correspondences, pinhole, start, views), {}, static_cast<int>(matches.size())};
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (located.estimate.inlier[i]) located.matches.push_back(matches[i]);
  return located;
}

std::optional<Located> locate(const Map& map, int keyframe_idx, const FrameFeatures& features,
                              const Pinhole& pinhole, int least_inliers) {
  const Keyframe& keyframe = map.keyframes[keyframe_idx];
  std::vector<char> used(keyframe.features->size());
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = keyframe.point_ids[i] >= 0;
  std::vector<Match> matches;
  std::vector<Correspondence> correspondences;
  for (const auto& [first, second] : match_descriptors(*keyframe.features, used, features)) {
    matches.push_back({second, keyframe.point_ids[first]});
    correspondences.push_back(
        {map.points[matches.back().point_id].position, measurement_of(features.feature(second), pinhole)});
  }
  const auto estimate = find_pose(correspondences, pinhole, least_inliers);
  if (!estimate) return {};
  Located located{*estimate, {}, static_cast<int>(matches.size())};
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (estimate->inlier[i]) located.matches.push_back(matches[i]);
  return located;
}

Widened widen(const Map& map, const std::vector<int>& keyframes, const FrameFeatures& features,
              const Pinhole& pinhole, const Pose& camera_from_world) {
  constexpr SearchRule kRule{8, 80, 0.9};
  const auto targets = visible_targets(map, points_of(map, keyframes), pinhole, camera_from_world);
  const std::vector<char> none_taken(features.size(), 0);
  const auto matches = match_targets(targets, features, none_taken, pinhole, kRule);
  return {solve_pose(map, matches, features, pinhole, camera_from_world), static_cast<int>(targets.size())};
}

std::vector<int> neighbourhood(const Map& map, int keyframe_idx, int most) {
  constexpr int kLeastShared = 15;
  std::vector<int> keyframes{keyframe_idx};
  for (const auto& [shared, other] : map.covisible(keyframe_idx, kLeastShared))
    if (static_cast<int>(keyframes.size()) < most) keyframes.push_back(other);
  return keyframes;
}

PlaceIndex index_of(const Map& map) {
  std::vector<const std::vector<Descriptor>*> places;
  for (const Keyframe& keyframe : map.keyframes) places.push_back(keyframe.features->descriptors().get());
  return PlaceIndex(places);
}

}  // namespace sediment::track
