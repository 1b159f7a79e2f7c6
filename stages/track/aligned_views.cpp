#include "stages/track/aligned_views.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "stages/track/dense_alignment.hpp"

namespace sediment::track {
namespace {

constexpr double kFarTurn_rad = 0.35, kFarMove_m = 0.4;  // views beyond see other surfaces

// Keyframes that look the same way, the nearest views first, no two of them neighbours.
std::vector<int> views_like(const Map& map, int segment, const Pose& world_from_camera) {
  constexpr int kMost = 3, kApart = 2;
  std::vector<std::pair<double, int>> ranked;
  for (int i = 0; i < static_cast<int>(map.keyframes.size()); ++i) {
    const Keyframe& keyframe = map.keyframes[i];
    if (keyframe.segment != segment || !keyframe.dense) continue;
    const Pose way = keyframe.world_from_camera.inverse() * world_from_camera;
    const double turn = rotation_angle(way) / kFarTurn_rad, move = norm(way.translation) / kFarMove_m;
    if (turn < 1 && move < 1) ranked.emplace_back(turn + move, i);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> chosen;
  for (const auto& [difference, i] : ranked) {
    if (static_cast<int>(chosen.size()) == kMost) break;
    if (std::none_of(chosen.begin(), chosen.end(), [&, i = i](int j) { return std::abs(i - j) < kApart; }))
      chosen.push_back(i);
  }
  return chosen;
}

bool is_sound(const DenseAlignment& alignment, const Pose& expected) {
  constexpr double kLeastOverlap = 0.5, kWorstDeviation = 0.02;
  constexpr double kMostTurned_rad = 0.06, kMostMoved_m = 0.12;
  const Pose change = alignment.current_from_reference * expected.inverse();
  return alignment.overlap >= kLeastOverlap && worst_deviation(alignment) <= kWorstDeviation &&
         rotation_angle(change) <= kMostTurned_rad && norm(change.translation) <= kMostMoved_m;
}

}  // namespace

std::vector<AlignedView> aligned_views(const Map& map, int segment, const DenseFrame& frame,
                                       const Pose& world_from_camera, const DenseCamera& camera,
                                       double depth_noise) {
  const DenseImages images = dense_images(frame, camera, depth_noise);
  std::vector<AlignedView> views;
  for (const int i : views_like(map, segment, world_from_camera)) {
    const Keyframe& keyframe = map.keyframes[i];
    const Pose expected = world_from_camera.inverse() * keyframe.world_from_camera;
    const DenseAlignment alignment =
        align(dense_images(*keyframe.dense, camera, depth_noise), images, camera, expected, 0, depth_noise);
    if (is_sound(alignment, expected))
      views.push_back(
          {keyframe.world_from_camera.inverse(), alignment.current_from_reference, alignment.information});
  }
  return views;
}

}  // namespace sediment::track
