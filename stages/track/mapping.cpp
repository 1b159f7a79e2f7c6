#include "stages/track/mapping.hpp"

#include <algorithm>
#include <limits>

#include "stages/track/map_adjustment.hpp"

namespace sediment::track {
namespace {

constexpr int kNeighbours = 10, kLeastShared = 15;

void create_points(Map& map, int keyframe_idx, const Pinhole& pinhole) {
  const Pose world_from_camera = map.keyframes[keyframe_idx].world_from_camera;
  const auto features = map.keyframes[keyframe_idx].features;
  for (int i = 0; i < static_cast<int>(features->size()); ++i) {
    if (map.keyframes[keyframe_idx].point_ids[i] >= 0 || features->feature(i).inverse_depth == 0) continue;
    map.add_point(world_from_camera * pinhole.point_of(features->feature(i)), {keyframe_idx, i});
  }
}

void cull_recent_points(Map& map, int keyframe_idx) {
  constexpr int kOldest = 3;
  // Points are in the order of the keyframes that made them.
  const auto recent = std::lower_bound(
      map.points.begin(), map.points.end(), keyframe_idx - kOldest,
      [](const MapPoint& point, int first_idx) { return point.first_keyframe_idx < first_idx; });
  for (auto point_id = recent - map.points.begin(); point_id < std::ssize(map.points); ++point_id) {
    const MapPoint& point = map.points[point_id];
    const int age = keyframe_idx - point.first_keyframe_idx;
    if (point.removed || age < 1) continue;
    const bool seldom_found = 4 * point.found < point.expected;
    const bool alone = age >= kOldest && point.sightings.size() < 2;
    if (seldom_found || alone) map.remove_point(static_cast<int>(point_id));
  }
}

}  // namespace

void fuse_into(Map& map, int keyframe_idx, const std::vector<int>& point_ids, const Pinhole& pinhole) {
  const Keyframe& keyframe = map.keyframes[keyframe_idx];
  std::vector<char> present(map.points.size(), 0);
  for (const int point_id : keyframe.point_ids)
    if (point_id >= 0) present[point_id] = 1;
  std::vector<int> absent;
  for (const int point_id : point_ids)
    if (!present[point_id]) absent.push_back(point_id);
  const std::vector<char> none_taken(keyframe.features->size(), 0);
  const SearchRule rule{3, 50, 1.0};
  const auto targets = visible_targets(map, absent, pinhole, keyframe.world_from_camera.inverse());
  for (const Match& match : match_targets(targets, *keyframe.features, none_taken, pinhole, rule)) {
    if (map.points[match.point_id].removed) continue;
    const Measurement measurement =
        measurement_of(keyframe.features->feature(match.feature_idx), pinhole, keyframe.noise_scale);
    const auto r = residual_of(measurement, pinhole,
                               keyframe.world_from_camera.inverse() * map.points[match.point_id].position);
    if (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] > chi_square_bound(measurement)) continue;
    const int there = keyframe.point_ids[match.feature_idx];
    if (there < 0) {
      map.connect(match.point_id, {keyframe_idx, match.feature_idx});
      map.refresh_point(match.point_id);
    } else {
      const bool keep_there =
          map.points[there].sightings.size() >= map.points[match.point_id].sightings.size();
      map.merge_points(keep_there ? there : match.point_id, keep_there ? match.point_id : there);
    }
  }
}

std::vector<int> points_of(const Map& map, const std::vector<int>& keyframes) {
  int least = std::numeric_limits<int>::max(), most = -1;
  for (const int keyframe_idx : keyframes)
    for (const int point_id : map.keyframes[keyframe_idx].point_ids) {
      if (point_id < 0) continue;
      least = std::min(least, point_id);
      most = std::max(most, point_id);
    }
  if (most < 0) return {};
  std::vector<char> seen(most - least + 1, 0);
  for (const int keyframe_idx : keyframes)
    for (const int point_id : map.keyframes[keyframe_idx].point_ids)
      if (point_id >= 0) seen[point_id - least] = 1;
  std::vector<int> point_ids;
  for (int point_id = least; point_id <= most; ++point_id)
    if (seen[point_id - least]) point_ids.push_back(point_id);
  return point_ids;
}

int add_keyframe(Map& map, int frame_idx, const Pose& world_from_camera,
                 std::shared_ptr<const FrameFeatures> features, const std::vector<Match>& matches,
                 double noise_scale, const Pinhole& pinhole) {
  const int keyframe_idx = static_cast<int>(map.keyframes.size());
  const std::size_t size = features->size();
  Keyframe keyframe;
  keyframe.frame_idx = frame_idx;
  keyframe.world_from_camera = world_from_camera;
  keyframe.features = std::move(features);
  keyframe.point_ids.assign(size, -1);
  keyframe.noise_scale = noise_scale;
  map.keyframes.push_back(std::move(keyframe));
  for (const Match& match : matches) {
    map.connect(match.point_id, {keyframe_idx, match.feature_idx});
    map.refresh_point(match.point_id);
  }
  cull_recent_points(map, keyframe_idx);
  create_points(map, keyframe_idx, pinhole);
  std::vector<int> neighbours;
  for (const auto& [shared, other] : map.covisible(keyframe_idx, kLeastShared))
    if (static_cast<int>(neighbours.size()) < kNeighbours) neighbours.push_back(other);
  for (const int other : neighbours) fuse_into(map, other, points_of(map, {keyframe_idx}), pinhole);
  fuse_into(map, keyframe_idx, points_of(map, neighbours), pinhole);
  if (!neighbours.empty()) adjust_around(map, keyframe_idx, pinhole);
  return keyframe_idx;
}

}  // namespace sediment::track
