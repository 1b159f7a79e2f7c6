#include "stages/track/loop_closing.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "stages/track/dense_alignment.hpp"
#include "stages/track/place_finding.hpp"
#include "stages/track/pose_graph.hpp"

namespace sediment::track {
namespace {

constexpr int kLeastShared = 15, kNeighbours = 10;
constexpr int kMostCandidates = 3;
constexpr double kLeastSimilar = 0.6;  // of the similarity to the neighbours that share landmarks
constexpr int kLeastByLooks = 25, kLeastInliers = 50;
constexpr int kLeastWhereExpected = 35;  // inliers, where the map expects the place
constexpr double kLeastSeen = 0.1;       // of the landmarks that should be visible
constexpr double kLeastOverlap = 0.3;    // of the surfaces

struct Loop {
  int from_idx = 0, to_idx = 0;
  Pose to_from_from;
  std::vector<Match> matches;  ///< features of `to`, landmarks seen around `from`
};

// What is needed to compare two keyframes.
struct Views {
  const Pinhole& pinhole;
  const DenseCamera& camera;
  double depth_noise;

  DenseAlignment aligned(const Keyframe& from, const Keyframe& to, const Pose& to_from_from) const {
    return align(dense_images(*from.dense, camera, depth_noise), dense_images(*to.dense, camera, depth_noise),
                 camera, to_from_from, 1, depth_noise);
  }
};

// Keyframes that look like this one but are not connected with it over at most one other, earlier ones only.
std::vector<int> candidates_of(const Map& map, const PlaceIndex& places, int keyframe_idx) {
  const auto direct = map.covisible(keyframe_idx, kLeastShared);
  std::vector<char> connected(map.keyframes.size(), 0);
  connected[keyframe_idx] = 1;
  double similar_to_neighbours = 0;
  for (const auto& [shared, other] : direct) {
    similar_to_neighbours += places.similarity(keyframe_idx, other) / static_cast<double>(direct.size());
    connected[other] = 1;
    for (const auto& [also_shared, next] : map.covisible(other, kLeastShared)) connected[next] = 1;
  }
  std::vector<int> candidates;
  for (const auto& place : places.similar(*map.keyframes[keyframe_idx].features->descriptors())) {
    if (place.similarity < kLeastSimilar * similar_to_neighbours) break;
    if (connected[place.place_idx] || place.place_idx > keyframe_idx) continue;
    candidates.push_back(place.place_idx);
    if (static_cast<int>(candidates.size()) == kMostCandidates) break;
  }
  return candidates;
}

// Where the second keyframe is in the world of the first by its looks alone; if too few descriptors agree, by
// the whole images, from where the map has both.
std::optional<Pose> first_guess(const Map& map, int from_idx, int to_idx, const Views& views,
                                bool& by_looks) {
  const Keyframe &from = map.keyframes[from_idx], &to = map.keyframes[to_idx];
  const auto located = locate(map, from_idx, *to.features, views.pinhole, kLeastByLooks);
  by_looks = located.has_value();
  if (located) return located->estimate.camera_from_world;
  if (from.segment != to.segment) return {};
  const Pose expected = to.world_from_camera.inverse() * from.world_from_camera;
  const DenseAlignment alignment = views.aligned(from, to, expected);
  if (alignment.overlap < kLeastOverlap) return {};
  return alignment.current_from_reference * from.world_from_camera.inverse();
}

std::optional<Loop> verified(const Map& map, int from_idx, int to_idx, const Views& views) {
  const Keyframe &from = map.keyframes[from_idx], &to = map.keyframes[to_idx];
  bool by_looks = false;
  const auto guess = first_guess(map, from_idx, to_idx, views, by_looks);
  if (!guess) return {};
  const Widened wide =
      widen(map, neighbourhood(map, from_idx, kNeighbours), *to.features, views.pinhole, *guess);
  const int inliers = wide.located.estimate.inliers;
  if (inliers < (by_looks ? kLeastInliers : kLeastWhereExpected) || inliers < kLeastSeen * wide.visible)
    return {};
  const Pose to_from_from = wide.located.estimate.camera_from_world * from.world_from_camera;
  if (views.aligned(from, to, to_from_from).overlap < kLeastOverlap) return {};
  return Loop{from_idx, to_idx, to_from_from, wide.located.matches};
}

std::vector<Loop> find_loops(const Map& map, const Views& views) {
  const PlaceIndex places = index_of(map);
  std::vector<std::vector<Loop>> found(map.keyframes.size());
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const int keyframe_idx = static_cast<int>(i);
    for (const int candidate : candidates_of(map, places, keyframe_idx))
      if (auto loop = verified(map, candidate, keyframe_idx, views)) found[i].push_back(std::move(*loop));
  });
  std::vector<Loop> loops;
  for (auto& of_one : found)
    for (Loop& loop : of_one) loops.push_back(std::move(loop));
  return loops;
}

// Moves a segment so that the loop fits, and makes it part of the other one, the earlier.
void join(Map& map, const Loop& loop) {
  const int a = map.keyframes[loop.from_idx].segment, b = map.keyframes[loop.to_idx].segment;
  const int kept = std::min(a, b), given_up = std::max(a, b);
  const Pose& from = map.keyframes[loop.from_idx].world_from_camera;
  const Pose& to = map.keyframes[loop.to_idx].world_from_camera;
  const Pose moved = given_up == b ? from * loop.to_from_from.inverse() * to.inverse()
                                   : to * loop.to_from_from * from.inverse();
  for (MapPoint& point : map.points)
    if (map.keyframes[point.first_keyframe_idx].segment == given_up) point.position = moved * point.position;
  for (Keyframe& keyframe : map.keyframes) {
    if (keyframe.segment != given_up) continue;
    keyframe.world_from_camera = moved * keyframe.world_from_camera;
    keyframe.segment = kept;
  }
}

PoseGraph graph_of(const Map& map, const std::vector<Loop>& loops) {
  constexpr int kStrong = 50;
  PoseGraph graph;
  std::vector<char> begun(map.keyframes.size(), 0);
  for (const Keyframe& keyframe : map.keyframes) {
    graph.camera_from_world.push_back(keyframe.world_from_camera.inverse());
    graph.fixed.push_back(!begun[keyframe.segment]);
    begun[keyframe.segment] = 1;
  }
  const auto connect = [&](int from, int to) {
    graph.edges.push_back(
        {from, to, graph.camera_from_world[to] * graph.camera_from_world[from].inverse(), 1});
  };
  for (int i = 0; i < static_cast<int>(map.keyframes.size()); ++i) {
    bool before = false;
    for (const auto& [shared, other] : map.covisible(i, kLeastShared)) {
      if (other > i || (before && shared < kStrong)) continue;
      before = true;
      connect(other, i);
    }
    // Keyframes that only whole images hold together.
    if (!before && !graph.fixed[i] && map.keyframes[i - 1].segment == map.keyframes[i].segment)
      connect(i - 1, i);
  }
  for (const Loop& loop : loops) graph.edges.push_back({loop.from_idx, loop.to_idx, loop.to_from_from, 1});
  return graph;
}

void move_to(const PoseGraph& graph, Map& map) {
  std::vector<Pose> moved;
  for (std::size_t i = 0; i < map.keyframes.size(); ++i) {
    const Pose after = graph.camera_from_world[i].inverse();
    moved.push_back(after * map.keyframes[i].world_from_camera.inverse());
    map.keyframes[i].world_from_camera = after;
  }
  for (MapPoint& point : map.points)
    if (!point.removed) point.position = moved[point.sightings.front().keyframe_idx] * point.position;
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (!map.points[i].removed) map.refresh_geometry(static_cast<int>(i));
}

void unite_landmarks(Map& map, const Loop& loop, const Pinhole& pinhole) {
  for (const Match& match : loop.matches) {
    if (map.points[match.point_id].removed) continue;
    const int there = map.keyframes[loop.to_idx].point_ids[match.feature_idx];
    if (there == match.point_id) continue;
    if (there >= 0)
      map.merge_points(match.point_id, there);
    else if (!map.sees(loop.to_idx, match.point_id)) {
      map.connect(match.point_id, {loop.to_idx, match.feature_idx});
      map.refresh_point(match.point_id);
    }
  }
  const auto around_from = points_of(map, neighbourhood(map, loop.from_idx, kNeighbours));
  for (const int keyframe_idx : neighbourhood(map, loop.to_idx, kNeighbours))
    fuse_into(map, keyframe_idx, around_from, pinhole);
}

}  // namespace

LoopClosing close_loops(Map& map, const Pinhole& pinhole, const DenseCamera& dense_camera,
                        double depth_noise) {
  LoopClosing closing;
  if (map.keyframes.size() < 3) return closing;
  const auto loops = find_loops(map, {pinhole, dense_camera, depth_noise});
  if (loops.empty()) return closing;
  closing.loops = static_cast<int>(loops.size());
  for (const Loop& loop : loops) {
    if (map.keyframes[loop.from_idx].segment == map.keyframes[loop.to_idx].segment) continue;
    join(map, loop);
    ++closing.joined;
  }
  PoseGraph graph = graph_of(map, loops);
  relax(graph);
  move_to(graph, map);
  for (const Loop& loop : loops) unite_landmarks(map, loop, pinhole);
  return closing;
}

}  // namespace sediment::track
