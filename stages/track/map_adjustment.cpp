#include "stages/track/map_adjustment.hpp"

#include <algorithm>
#include <utility>

namespace sediment::track {
namespace {

constexpr int kLocalKeyframes = 8, kFixedKeyframes = 16, kLeastShared = 15;
constexpr int kLocalIterations = 5, kFullIterations = 12;
constexpr double kNearest_m = 0.1;
constexpr double kBelievedGain = 0.01;  // share of the cost that a change of the sensor's timing must save

// A part of the map as the solver takes it, and where its numbers came from.
struct Extract {
  Bundle bundle;
  std::vector<int> keyframe_idx, point_id;  ///< per camera, per point
  std::vector<Sighting> sightings;          ///< per observation
};

// Keyframes with their flag `fixed`, and all points that the free ones see.
Extract extract(const Map& map, const std::vector<std::pair<int, bool>>& keyframes, const Pinhole& pinhole) {
  Extract part;
  std::vector<int> camera_of(map.keyframes.size(), -1), point_of(map.points.size(), -1);
  for (const auto& [keyframe_idx, fixed] : keyframes) {
    camera_of[keyframe_idx] = static_cast<int>(part.keyframe_idx.size());
    part.keyframe_idx.push_back(keyframe_idx);
    part.bundle.cameras.push_back({map.keyframes[keyframe_idx].world_from_camera.inverse(), fixed});
  }
  for (const auto& [keyframe_idx, fixed] : keyframes)
    for (const int point_id : map.keyframes[keyframe_idx].point_ids) {
      if (fixed || point_id < 0 || point_of[point_id] >= 0) continue;
      point_of[point_id] = static_cast<int>(part.point_id.size());
      part.point_id.push_back(point_id);
      part.bundle.points.push_back(map.points[point_id].position);
    }
  for (const Link& link : map.links) {
    const int from = camera_of[link.from_idx], to = camera_of[link.to_idx];
    if (from >= 0 && to >= 0) part.bundle.links.push_back({from, to, link.to_from_from, link.information});
  }
  for (std::size_t i = 0; i < part.point_id.size(); ++i)
    for (const Sighting& s : map.points[part.point_id[i]].sightings) {
      if (camera_of[s.keyframe_idx] < 0) continue;
      const Bundle::Observation o{
          camera_of[s.keyframe_idx], static_cast<int>(i),
          measurement_of(map.keyframes[s.keyframe_idx].features->feature(s.feature_idx), pinhole,
                         map.keyframes[s.keyframe_idx].noise_scale)};
      const Vec3 p = part.bundle.cameras[o.camera_idx].camera_from_world * part.bundle.points[i];
      if (p.z < kNearest_m) continue;
      part.bundle.observations.push_back(o);
      part.sightings.push_back(s);
    }
  return part;
}

void write_back(const Extract& part, Map& map) {
  for (std::size_t i = 0; i < part.keyframe_idx.size(); ++i)
    if (!part.bundle.cameras[i].fixed)
      map.keyframes[part.keyframe_idx[i]].world_from_camera =
          part.bundle.cameras[i].camera_from_world.inverse();
  for (std::size_t i = 0; i < part.point_id.size(); ++i)
    map.points[part.point_id[i]].position = part.bundle.points[i];
}

// Takes out what does not fit, and landmarks that nothing holds any more.
void drop_outliers(const Extract& part, const Pinhole& pinhole, Map& map) {
  std::vector<char> changed(part.point_id.size(), 0);
  for (std::size_t i = 0; i < part.sightings.size(); ++i) {
    const Bundle::Observation& o = part.bundle.observations[i];
    if (chi_square(part.bundle, o, pinhole) <= chi_square_bound(o.measurement)) continue;
    map.disconnect(part.point_id[o.point_idx], part.sightings[i].keyframe_idx);
    changed[o.point_idx] = 1;
  }
  for (std::size_t i = 0; i < part.point_id.size(); ++i)
    if (map.points[part.point_id[i]].sightings.empty())
      map.remove_point(part.point_id[i]);
    else if (changed[i])
      map.refresh_point(part.point_id[i]);
    else
      map.refresh_geometry(part.point_id[i]);
}

}  // namespace

void adjust_around(Map& map, int keyframe_idx, const Pinhole& pinhole) {
  std::vector<std::pair<int, bool>> keyframes{{keyframe_idx, keyframe_idx == 0}};
  std::vector<char> chosen(map.keyframes.size(), 0);
  chosen[keyframe_idx] = 1;
  const auto choose = [&](int other) {
    if (chosen[other] || static_cast<int>(keyframes.size()) >= kLocalKeyframes) return;
    keyframes.emplace_back(other, other == 0);
    chosen[other] = 1;
  };
  for (const Link& link : map.links)
    if (link.to_idx == keyframe_idx) choose(link.from_idx);
  for (const auto& [shared, other] : map.covisible(keyframe_idx, kLeastShared)) choose(other);
  // Keyframes outside that hold the most of these landmarks keep the window in place.
  std::vector<int> votes(map.keyframes.size(), 0);
  std::vector<char> counted(map.points.size(), 0);
  for (const auto& [free_idx, fixed] : keyframes)
    for (const int point_id : map.keyframes[free_idx].point_ids) {
      if (point_id < 0 || counted[point_id]++) continue;
      for (const Sighting& s : map.points[point_id].sightings)
        votes[s.keyframe_idx] += !chosen[s.keyframe_idx];
    }
  std::vector<std::pair<int, int>> outside;
  for (int i = 0; i < static_cast<int>(votes.size()); ++i)
    if (votes[i] > 0) outside.emplace_back(-votes[i], i);
  std::sort(outside.begin(), outside.end());
  for (std::size_t i = 0; i < outside.size() && i < kFixedKeyframes; ++i)
    keyframes.emplace_back(outside[i].second, true);
  const bool held = std::any_of(keyframes.begin(), keyframes.end(), [](const auto& k) { return k.second; });
  if (!held) keyframes.back().second = true;
  Extract part = extract(map, keyframes, pinhole);
  adjust(part.bundle, pinhole, {kLocalIterations, true});
  write_back(part, map);
  drop_outliers(part, pinhole, map);
}

SensorTiming adjust_all(Map& map, const Pinhole& pinhole, const SensorTiming& timing) {
  std::vector<std::pair<int, bool>> keyframes;
  keyframes.reserve(map.keyframes.size());
  std::vector<char> begun(map.keyframes.size(), 0);  // the first one of a segment stays where it is
  for (int i = 0; i < static_cast<int>(map.keyframes.size()); ++i)
    keyframes.emplace_back(i, !std::exchange(begun[map.keyframes[i].segment], 1));
  const auto adjusted = [&](Extract part, bool robust, bool timed) {
    part.bundle.timing = timing;
    const double cost = adjust(part.bundle, pinhole, {kFullIterations, robust, timed, true});
    return std::pair(cost, std::move(part));
  };
  const Extract with_outliers = adjusted(extract(map, keyframes, pinhole), true, true).second;
  write_back(with_outliers, map);
  drop_outliers(with_outliers, pinhole, map);
  auto [timed_cost, last] = adjusted(extract(map, keyframes, pinhole), false, true);
  const bool known =
      timing.readout_s != 0 || timing.depth_lag_s != 0;  // what is believed once is only made finer
  if (!known) {
    auto [cost, untimed] = adjusted(last, false, false);
    if (timed_cost >= (1 - kBelievedGain) * cost) last = std::move(untimed);
  }
  write_back(last, map);
  drop_outliers(last, pinhole, map);
  return last.bundle.timing;
}

}  // namespace sediment::track
