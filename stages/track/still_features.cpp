#include "stages/track/still_features.hpp"

#include <vector>

#include "stages/track/completion.hpp"

namespace sediment::track {
namespace {

constexpr int kNeighbours = 20;

// Landmarks of the features behind the first `trusted` of a keyframe.
void create_points(Map& map, int keyframe_idx, std::size_t trusted, const Pinhole& pinhole) {
  const Pose world_from_camera = map.keyframes[keyframe_idx].world_from_camera;
  const auto features = map.keyframes[keyframe_idx].features;
  for (std::size_t i = trusted; i < features->size(); ++i)
    if (features->feature(i).inverse_depth > 0)
      map.add_point(world_from_camera * pinhole.point_of(features->feature(i)),
                    {keyframe_idx, static_cast<int>(i)});
}

// In how many keyframes around it a camera should see each of these landmarks.
std::vector<int> views_of(const Map& map, int first_id, const Pinhole& pinhole) {
  std::vector<int> views(map.points.size() - static_cast<std::size_t>(first_id), 0);
  for (int i = 0; i < static_cast<int>(map.keyframes.size()); ++i) {
    std::vector<int> new_points;
    for (const int point_id : points_of(map, neighbourhood(map, i, kNeighbours)))
      if (point_id >= first_id) new_points.push_back(point_id);
    const Pose camera_from_world = map.keyframes[i].world_from_camera.inverse();
    for (const Target& target : visible_targets(map, new_points, pinhole, camera_from_world))
      ++views[static_cast<std::size_t>(target.point_id - first_id)];
  }
  return views;
}

}  // namespace

std::vector<std::size_t> join_waiting_features(Tracker& tracker) {
  std::vector<std::size_t> trusted;
  for (const Keyframe& keyframe : tracker.map().keyframes) trusted.push_back(keyframe.features->size());
  for (TrackedFrame& frame : tracker.frames())
    if (frame.tracked && frame.waiting)  // what is lost is looked for with trusted features alone
      frame.features = std::make_shared<const FrameFeatures>(frame.features->joined(*frame.waiting));
  for (Keyframe& keyframe : tracker.map().keyframes) {
    keyframe.features = tracker.frames()[keyframe.frame_idx].features;
    keyframe.point_ids.resize(keyframe.features->size(), -1);
  }
  return trusted;
}

int admit_still_features(Map& map, const std::vector<std::size_t>& trusted, const Pinhole& pinhole) {
  constexpr int kLeastSightings = 3, kViewsASighting = 3;
  const int first_id = static_cast<int>(map.points.size());
  for (std::size_t i = 0; i < map.keyframes.size(); ++i)
    create_points(map, static_cast<int>(i), trusted[i], pinhole);
  match_again(map, pinhole);
  const std::vector<int> views = views_of(map, first_id, pinhole);
  int admitted = 0;
  for (int point_id = first_id; point_id < static_cast<int>(map.points.size()); ++point_id) {
    const MapPoint& point = map.points[point_id];
    const int sightings = static_cast<int>(point.sightings.size());
    if (sightings >= kLeastSightings && kViewsASighting * sightings >= views[point_id - first_id])
      ++admitted;
    else if (!point.removed)
      map.remove_point(point_id);
  }
  return admitted;
}

}  // namespace sediment::track
