#include "stages/track/tracker.hpp"

#include <algorithm>
#include <cmath>

#include "stages/track/mapping.hpp"

namespace sediment::track {
namespace {

constexpr int kLeastToStart = 50;    // features with depth in the first keyframe
constexpr int kLeastToFollow = 15;   // inliers that make a first pose
constexpr int kLeastToAccept = 20;   // inliers that make a pose
constexpr int kLeastToRecover = 20;  // inliers without any guess of the pose
constexpr int kLocalKeyframes = 30;
constexpr int kPlenty = 150;     // landmarks of the last frame found again
constexpr int kFewInliers = 80;  // below, a keyframe hangs on the alignment of whole images too
constexpr double kLongestPrediction_s = 1.0;
constexpr double kFarTurn_rad = 0.2, kFarMove_m = 0.15;  // from a keyframe: time for a new one
constexpr double kFewPoints = 0.75;                      // of the landmarks of its reference keyframe

}  // namespace

Pose camera_from_world(const TrackedFrame& frame, const Map& map) {
  return frame.camera_from_reference * map.keyframes[frame.reference_idx].world_from_camera.inverse();
}

void Tracker::track(double stamp_s, const View& view) {
  TrackedFrame frame;
  frame.stamp_s = stamp_s;
  frame.features = view.features;
  frame.waiting = view.waiting;
  frame.dense = view.dense;
  frames_.push_back(std::move(frame));
  images_ = nullptr;
  if (map_.keyframes.empty()) {
    start_map();
    return;
  }
  std::optional<Found> found;
  if (const auto predicted = predicted_pose()) found = find_nearby(*predicted);
  if (!found) {
    found = locate(map_, frames_[last_tracked_].reference_idx, *view.features, pinhole_, kLeastToRecover);
    if (found) found = match_local_map(*found);
  }
  if (!found) {
    found = relocalise();
    if (found) found = match_local_map(*found);
  }
  if (found)
    accept(*found);
  else if (wants_segment())
    start_map();
}

// Where the camera is lost for long it may be somewhere new: a map of its own begins, which a loop may join.
bool Tracker::wants_segment() const {
  constexpr int kLostFor = 5;
  return parameters_.mode == Mode::offline &&
         static_cast<int>(frames_.size()) - 1 - last_tracked_ >= kLostFor;
}

// From a good guess of the pose. Whole images are aligned only where features tell little: it takes longer.
std::optional<Tracker::Found> Tracker::find_nearby(const Pose& predicted) {
  Pose start = predicted;
  std::optional<Found> found = follow_last_frame(start);
  if (!found || found->estimate.inliers < kPlenty) {
    if (const auto aligned = aligned_to_last(predicted)) {
      start = *aligned;
      auto again = follow_last_frame(start);
      if (again && (!found || again->estimate.inliers >= found->estimate.inliers)) found = std::move(again);
    }
  }
  if (found) found = match_local_map(*found);
  // Surfaces alone look alike in many places: they may carry on from the frame before, but not find the way
  // back.
  const bool unbroken = last_tracked_ + 2 == static_cast<int>(frames_.size());
  if (!found && unbroken) found = align_to_keyframe(start);
  return found;
}

bool Tracker::start_map() {
  TrackedFrame& frame = frames_.back();
  int with_depth = 0;
  for (const Feature& feature : frame.features->features()) with_depth += feature.inverse_depth > 0;
  if (with_depth < kLeastToStart) return false;
  frame.tracked = frame.keyframe = true;
  frame.reference_idx =
      add_keyframe(map_, static_cast<int>(frames_.size()) - 1, {}, frame.features, {}, 1, pinhole_);
  frame.matches = frame.inliers = with_depth;
  last_tracked_ = static_cast<int>(frames_.size()) - 1;
  last_images_ = nullptr;
  last_matches_.clear();
  map_.keyframes.back().dense = frame.dense;
  map_.keyframes.back().segment = segments_++;
  for (int i = 0; i < static_cast<int>(frame.features->size()); ++i)
    if (const int point_id = map_.keyframes.back().point_ids[i]; point_id >= 0)
      last_matches_.push_back({i, point_id});
  return true;
}

// Constant velocity, if the last frames are near enough in time to tell it.
std::optional<Pose> Tracker::predicted_pose() const {
  const int now = static_cast<int>(frames_.size()) - 1;
  const TrackedFrame& last = frames_[last_tracked_];
  const double ahead_s = frames_[now].stamp_s - last.stamp_s;
  if (ahead_s > kLongestPrediction_s) return {};
  const Pose last_pose = camera_from_world(last, map_);
  if (last_tracked_ == 0 || !frames_[last_tracked_ - 1].tracked) return last_pose;
  const TrackedFrame& before = frames_[last_tracked_ - 1];
  const double between_s = last.stamp_s - before.stamp_s;
  if (between_s <= 0 || between_s > kLongestPrediction_s) return last_pose;
  const Pose motion = last_pose * camera_from_world(before, map_).inverse();
  const double fraction = std::min(ahead_s / between_s, 3.0);
  Pose moved;  // the motion repeated `fraction` times
  for (int i = 0; i < static_cast<int>(fraction); ++i) moved = motion * moved;
  return interpolate({}, motion, fraction - std::floor(fraction)) * moved * last_pose;
}

std::optional<Tracker::Found> Tracker::follow_last_frame(const Pose& predicted) const {
  const FrameFeatures& features = *frames_.back().features;
  const FrameFeatures& last = *frames_[last_tracked_].features;
  const std::vector<char> none_taken(features.size(), 0);
  std::vector<Target> targets;
  for (const Match& match : last_matches_) {
    const MapPoint& point = map_.points[match.point_id];
    if (point.removed) continue;
    const Vec3 p = predicted * point.position;
    if (p.z < 0.1) continue;
    targets.push_back({match.point_id, pinhole_.project(p), 1 / p.z, last.feature(match.feature_idx).octave,
                       &last.descriptor(match.feature_idx)});
  }
  for (const double radius_px : {15.0, 40.0}) {
    const auto matches = match_targets(targets, features, none_taken, pinhole_, {radius_px, 100, 0.9});
    if (static_cast<int>(matches.size()) < kLeastToFollow) continue;
    Found found = solve_pose(map_, matches, features, pinhole_, predicted);
    if (found.estimate.inliers >= kLeastToFollow && 3 * found.estimate.inliers >= found.tried) return found;
  }
  return {};
}

// Against the keyframes that look most like the frame. The index is made again when the map has grown by a
// quarter; keyframes that it does not know yet are tried first, latest first.
std::optional<Tracker::Found> Tracker::relocalise() {
  constexpr int kMostTried = 8;
  const FrameFeatures& features = *frames_.back().features;
  if (static_cast<int>(features.size()) < kLeastToRecover) return {};
  if (!places_ || 4 * map_.keyframes.size() > 5 * places_->size()) places_ = index_of(map_);
  std::vector<int> tried;
  for (auto i = std::ssize(map_.keyframes) - 1; i >= std::ssize(*places_); --i)
    tried.push_back(static_cast<int>(i));
  if (tried.size() > kMostTried / 2) tried.resize(kMostTried / 2);
  for (const auto& place : places_->similar(*features.descriptors()))
    if (static_cast<int>(tried.size()) < kMostTried) tried.push_back(place.place_idx);
  for (const int keyframe_idx : tried)
    if (auto found = locate(map_, keyframe_idx, features, pinhole_, kLeastToRecover)) return found;
  return {};
}

std::optional<Tracker::Found> Tracker::match_local_map(const Found& start) {
  std::vector<int> votes(map_.keyframes.size(), 0);
  for (const Match& match : start.matches)
    for (const Sighting& sighting : map_.points[match.point_id].sightings) ++votes[sighting.keyframe_idx];
  std::vector<std::pair<int, int>> ranked;
  for (int i = 0; i < static_cast<int>(votes.size()); ++i)
    if (votes[i] > 0) ranked.emplace_back(-votes[i], -i);
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> local;
  for (const auto& [vote, minus_idx] : ranked)
    if (static_cast<int>(local.size()) < kLocalKeyframes) local.push_back(-minus_idx);
  if (local.empty()) return {};

  const FrameFeatures& features = *frames_.back().features;
  std::vector<Match> matches = start.matches;
  std::vector<char> taken(features.size(), 0), matched(map_.points.size(), 0);
  for (const Match& match : matches) taken[match.feature_idx] = matched[match.point_id] = 1;
  std::vector<int> others;
  for (const int point_id : points_of(map_, local))
    if (!matched[point_id]) others.push_back(point_id);
  const auto targets = visible_targets(map_, others, pinhole_, start.estimate.camera_from_world);
  const auto more = match_targets(targets, features, taken, pinhole_, {8, 90, 0.8});
  matches.insert(matches.end(), more.begin(), more.end());
  Found found = solve_pose(map_, matches, features, pinhole_, start.estimate.camera_from_world);
  for (const Target& target : targets) ++map_.points[target.point_id].expected;
  for (const Match& match : start.matches) ++map_.points[match.point_id].expected;
  for (const Match& match : found.matches) ++map_.points[match.point_id].found;
  frames_.back().reference_idx = local.front();
  if (found.estimate.inliers < kLeastToAccept) return {};
  return found;
}

bool Tracker::wants_keyframe(const Found& found) const {
  const TrackedFrame& frame = frames_.back();
  const Keyframe& reference = map_.keyframes[frame.reference_idx];
  int reference_points = 0;
  for (const int point_id : reference.point_ids)
    reference_points += point_id >= 0 && map_.points[point_id].sightings.size() > 1;
  const Pose from_reference = found.estimate.camera_from_world * reference.world_from_camera;
  if (rotation_angle(from_reference) > kFarTurn_rad || norm(from_reference.translation) > kFarMove_m)
    return true;
  const int since = static_cast<int>(frames_.size()) - 1 - map_.keyframes.back().frame_idx;
  return since >= 20 || found.estimate.inliers < kFewPoints * reference_points ||
         found.estimate.inliers < 100;
}

void Tracker::accept(const Found& found) {
  TrackedFrame& frame = frames_.back();
  frame.tracked = true;
  frame.matches = found.tried;
  frame.inliers = found.estimate.inliers;
  frame.residual_px = found.estimate.residual_px;
  frame.camera_from_reference =
      found.estimate.camera_from_world * map_.keyframes[frame.reference_idx].world_from_camera;
  last_tracked_ = static_cast<int>(frames_.size()) - 1;
  last_matches_ = found.matches;
  last_images_ = nullptr;
  frame.world_from_camera_then = found.estimate.camera_from_world.inverse();
  if (!wants_keyframe(found)) return;
  frame.keyframe = true;
  const int before = frame.reference_idx;
  frame.reference_idx = add_keyframe(map_, last_tracked_, found.estimate.camera_from_world.inverse(),
                                     frame.features, found.matches, found.estimate.noise_scale, pinhole_);
  frame.camera_from_reference = {};
  map_.keyframes.back().dense = frame.dense;
  map_.keyframes.back().segment = map_.keyframes[before].segment;
  if (found.estimate.inliers < kFewInliers) {
    link(before, frame.reference_idx);
    if (frame.reference_idx - 1 != before) link(frame.reference_idx - 1, frame.reference_idx);
  }
  last_matches_.clear();
  const auto& point_ids = map_.keyframes.back().point_ids;
  for (int i = 0; i < static_cast<int>(point_ids.size()); ++i)
    if (point_ids[i] >= 0) last_matches_.push_back({i, point_ids[i]});
}

}  // namespace sediment::track
