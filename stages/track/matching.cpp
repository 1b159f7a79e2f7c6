#include "stages/track/matching.hpp"

#include <algorithm>
#include <cmath>

namespace sediment::track {
namespace {

constexpr double kDepthGate = 5;  // standard deviations between the depth expected and the one measured
constexpr double kCosOfWidestAngle = 0.5;

struct Nearest {
  int idx = -1, distance = 257, second_distance = 257, octave = 0, second_octave = 0;

  void offer(int candidate_idx, int candidate_distance, int candidate_octave) {
    if (candidate_distance < distance) {
      second_distance = distance;
      second_octave = octave;
      idx = candidate_idx;
      distance = candidate_distance;
      octave = candidate_octave;
    } else if (candidate_distance < second_distance) {
      second_distance = candidate_distance;
      second_octave = candidate_octave;
    }
  }
};

// Predicted depth against a measured one: a loose gate, poses are not final yet.
bool depth_agrees(double expected_inverse, float measured_inverse, double depth_sigma) {
  return measured_inverse == 0 ||
         std::abs(expected_inverse - measured_inverse) < kDepthGate * depth_sigma + 0.1 * expected_inverse;
}

__attribute__((target_clones("popcnt", "default"))) Nearest nearest_of(const Descriptor& descriptor,
                                                                       const FrameFeatures& features,
                                                                       const std::vector<int>& candidates) {
  Nearest nearest;
  for (const int idx : candidates)
    nearest.offer(idx, hamming_distance(descriptor, features.descriptor(idx)), features.feature(idx).octave);
  return nearest;
}

// For every row the nearest and second nearest column, and for every column the nearest row.
__attribute__((target_clones("popcnt", "default"))) void nearest_both_ways(
    const std::vector<Descriptor>& rows, const std::vector<char>& row_used,
    const std::vector<Descriptor>& columns, std::vector<Nearest>& of_row, std::vector<Nearest>& of_column) {
  of_row.assign(rows.size(), {});
  of_column.assign(columns.size(), {});
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (!row_used[row]) continue;
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const int distance = hamming_distance(rows[row], columns[column]);
      of_row[row].offer(static_cast<int>(column), distance, 0);
      of_column[column].offer(static_cast<int>(row), distance, 0);
    }
  }
}

}  // namespace

std::vector<Match> match_targets(const std::vector<Target>& targets, const FrameFeatures& features,
                                 const std::vector<char>& taken, const Pinhole& pinhole,
                                 const SearchRule& rule) {
  std::vector<int> winner(features.size(), -1), winning_distance(features.size(), 257), near, candidates;
  for (const Target& target : targets) {
    const float radius_px = static_cast<float>(rule.radius_px * kLevelScale[target.octave]);
    features.find_near(static_cast<float>(target.pixel.u), static_cast<float>(target.pixel.v), radius_px,
                       target.octave - 1, target.octave + 1, near);
    candidates.clear();
    for (const int idx : near)
      if (!taken[idx] &&
          depth_agrees(target.inverse_depth, features.feature(idx).inverse_depth, pinhole.depth_sigma))
        candidates.push_back(idx);
    const Nearest best = nearest_of(*target.descriptor, features, candidates);
    if (best.idx < 0 || best.distance > rule.max_distance) continue;
    // Two features on one octave that look alike are ambiguous; on two octaves they may well be one corner.
    if (best.octave == best.second_octave && best.distance > rule.best_to_second * best.second_distance)
      continue;
    if (best.distance >= winning_distance[best.idx]) continue;
    winner[best.idx] = target.point_id;
    winning_distance[best.idx] = best.distance;
  }
  std::vector<Match> matches;
  for (std::size_t idx = 0; idx < winner.size(); ++idx)
    if (winner[idx] >= 0) matches.push_back({static_cast<int>(idx), winner[idx]});
  return matches;
}

std::vector<Target> visible_targets(const Map& map, const std::vector<int>& point_ids, const Pinhole& pinhole,
                                    const Pose& camera_from_world) {
  const Vec3 centre = camera_from_world.inverse().translation;
  std::vector<Target> targets;
  for (const int point_id : point_ids) {
    const MapPoint& point = map.points[point_id];
    if (point.removed) continue;
    const Vec3 p = camera_from_world * point.position;
    if (p.z < 0.1) continue;
    const Pixel pixel = pinhole.project(p);
    if (!pinhole.sees(pixel)) continue;
    const Vec3 ray = point.position - centre;
    const double distance_m = norm(ray);
    if (distance_m < 0.8 * point.min_distance_m || distance_m > 1.2 * point.max_distance_m) continue;
    if (dot(ray, point.viewing_direction) < kCosOfWidestAngle * distance_m) continue;
    const double octave =
        std::ceil(std::log(point.max_distance_m / distance_m) / std::log(kPyramidScale) - 0.5);
    targets.push_back({point_id, pixel, 1 / p.z,
                       static_cast<int>(std::clamp(octave, 0.0, kPyramidLevels - 1.0)), &point.descriptor});
  }
  return targets;
}

std::vector<std::pair<int, int>> match_descriptors(const FrameFeatures& first,
                                                   const std::vector<char>& first_used,
                                                   const FrameFeatures& second) {
  constexpr int kMaxDistance = 70;
  constexpr double kBestToSecond = 0.85;
  std::vector<Nearest> of_first, of_second;
  nearest_both_ways(*first.descriptors(), first_used, *second.descriptors(), of_first, of_second);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < of_first.size(); ++i) {
    const Nearest& best = of_first[i];
    if (best.idx < 0 || best.distance > kMaxDistance || of_second[best.idx].idx != static_cast<int>(i))
      continue;
    if (best.distance > kBestToSecond * best.second_distance) continue;
    pairs.emplace_back(static_cast<int>(i), best.idx);
  }
  return pairs;
}

}  // namespace sediment::track
