#include "stages/track/map.hpp"

#include <algorithm>
#include <array>

namespace sediment::track {
namespace {

auto by_keyframe(const Sighting& a, const Sighting& b) {
  return a.keyframe_idx < b.keyframe_idx;
}

bool seen_in(const MapPoint& point, int keyframe_idx) {
  return std::binary_search(point.sightings.begin(), point.sightings.end(), Sighting{keyframe_idx, 0},
                            by_keyframe);
}

constexpr std::size_t kVoters = 16;  // latest sightings: enough for a fair vote

// The descriptor whose median distance to the others is least.
__attribute__((target_clones("popcnt", "default"))) std::size_t most_central(
    const std::vector<const Descriptor*>& descriptors) {
  std::size_t central = 0;
  int best = 257;
  std::array<int, kVoters> distances{};
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    for (std::size_t j = 0; j < descriptors.size(); ++j)
      distances[j] = hamming_distance(*descriptors[i], *descriptors[j]);
    const auto middle = distances.begin() + descriptors.size() / 2;
    std::nth_element(distances.begin(), middle, distances.begin() + descriptors.size());
    if (*middle < best) {
      best = *middle;
      central = i;
    }
  }
  return central;
}

}  // namespace

void Map::connect(int point_id, Sighting sighting) {
  auto& sightings = points[point_id].sightings;
  sightings.insert(std::upper_bound(sightings.begin(), sightings.end(), sighting, by_keyframe), sighting);
  keyframes[sighting.keyframe_idx].point_ids[sighting.feature_idx] = point_id;
}

void Map::disconnect(int point_id, int keyframe_idx) {
  auto& sightings = points[point_id].sightings;
  const auto it =
      std::lower_bound(sightings.begin(), sightings.end(), Sighting{keyframe_idx, 0}, by_keyframe);
  if (it == sightings.end() || it->keyframe_idx != keyframe_idx) return;
  keyframes[keyframe_idx].point_ids[it->feature_idx] = -1;
  sightings.erase(it);
}

int Map::add_point(Vec3 position, Sighting first) {
  const int point_id = static_cast<int>(points.size());
  MapPoint point;
  point.position = position;
  point.first_keyframe_idx = first.keyframe_idx;
  point.expected = point.found = 1;
  points.push_back(std::move(point));
  connect(point_id, first);
  refresh_point(point_id);
  return point_id;
}

void Map::remove_point(int point_id) {
  MapPoint& point = points[point_id];
  for (const Sighting& s : point.sightings) keyframes[s.keyframe_idx].point_ids[s.feature_idx] = -1;
  point.sightings.clear();
  point.removed = true;
}

void Map::merge_points(int kept, int given_up) {
  if (kept == given_up) return;
  const std::vector<Sighting> moved = points[given_up].sightings;
  points[kept].expected += points[given_up].expected;
  points[kept].found += points[given_up].found;
  remove_point(given_up);
  for (const Sighting& sighting : moved)
    if (!seen_in(points[kept], sighting.keyframe_idx)) connect(kept, sighting);
  refresh_point(kept);
}

void Map::refresh_geometry(int point_id) {
  MapPoint& point = points[point_id];
  if (point.sightings.empty()) return;
  Vec3 sum{};
  for (const Sighting& s : point.sightings)
    sum = sum + normalized(point.position - keyframes[s.keyframe_idx].world_from_camera.translation);
  point.viewing_direction = norm(sum) > 1e-9 ? normalized(sum) : sum;
  const Sighting& latest = point.sightings.back();
  const Keyframe& keyframe = keyframes[latest.keyframe_idx];
  const double distance_m = norm(point.position - keyframe.world_from_camera.translation);
  point.max_distance_m = distance_m * kLevelScale[keyframe.features->feature(latest.feature_idx).octave];
  point.min_distance_m = point.max_distance_m / kLevelScale[kPyramidLevels - 1];
}

void Map::refresh_point(int point_id) {
  refresh_geometry(point_id);
  MapPoint& point = points[point_id];
  if (point.sightings.empty()) return;
  std::vector<const Descriptor*> descriptors;
  const std::size_t first = point.sightings.size() - std::min(point.sightings.size(), kVoters);
  for (std::size_t i = first; i < point.sightings.size(); ++i)
    descriptors.push_back(&descriptor(point.sightings[i]));
  point.descriptor = *descriptors[most_central(descriptors)];
}

bool Map::sees(int keyframe_idx, int point_id) const {
  return seen_in(points[point_id], keyframe_idx);
}

std::vector<std::pair<int, int>> Map::covisible(int keyframe_idx, int least) const {
  std::vector<int> shared(keyframes.size(), 0);
  for (const int point_id : keyframes[keyframe_idx].point_ids)
    if (point_id >= 0)
      for (const Sighting& sighting : points[point_id].sightings) ++shared[sighting.keyframe_idx];
  std::vector<std::pair<int, int>> found;
  for (int other = 0; other < static_cast<int>(shared.size()); ++other)
    if (other != keyframe_idx && shared[other] >= least) found.emplace_back(shared[other], other);
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  return found;
}

}  // namespace sediment::track
