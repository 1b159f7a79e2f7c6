#include "tools/evaluate-trajectory/relative_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/evaluate-trajectory/matching.hpp"
#include "tools/evaluate-trajectory/python_random.hpp"

namespace sediment::tools {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
using IndexPair = std::pair<std::size_t, std::size_t>;

double median_interval(const std::vector<double>& stamps_s) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < stamps_s.size(); ++i) intervals.push_back(stamps_s[i] - stamps_s[i - 1]);
  if (intervals.empty()) return 0;
  std::sort(intervals.begin(), intervals.end());
  const std::size_t middle = intervals.size() / 2;
  return intervals.size() % 2 == 1 ? intervals[middle] : (intervals[middle - 1] + intervals[middle]) / 2;
}

std::vector<IndexPair> random_pairs(std::size_t poses, std::size_t max_pairs) {
  std::vector<IndexPair> pairs;
  if (static_cast<double>(poses) < std::sqrt(static_cast<double>(max_pairs))) {
    for (std::size_t i = 0; i < poses; ++i)
      for (std::size_t j = 0; j < poses; ++j) pairs.emplace_back(i, j);
    return pairs;
  }
  PythonRandom random(0);
  for (std::size_t k = 0; k < max_pairs; ++k) {
    const std::size_t first = random.index_up_to(poses - 1);
    pairs.emplace_back(first, random.index_up_to(poses - 1));
  }
  return pairs;
}

/// `positions` are what the delta is counted in: seconds or frames.
std::vector<IndexPair> fixed_delta_pairs(const std::vector<double>& positions, double delta) {
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::size_t j = closest_index(positions, positions[i] + delta);
    if (j + 1 != positions.size()) pairs.emplace_back(i, j);
  }
  return pairs;
}

std::vector<IndexPair> pairs_of(const Trajectory& estimate, const RelativePairs& rule) {
  if (rule.rule == RelativePairs::Rule::random) return random_pairs(estimate.size(), rule.max_pairs);
  std::vector<double> positions = stamps_of(estimate);
  if (rule.rule == RelativePairs::Rule::frames)
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<double>(i);
  return fixed_delta_pairs(positions, rule.delta);
}

}  // namespace

double distance_from_identity(const Pose& pose) {
  double sum = dot(pose.translation, pose.translation);
  for (int i = 0; i < 9; ++i) {
    const double difference = pose.rotation[i] - (i % 4 == 0 ? 1 : 0);
    sum += difference * difference;
  }
  return std::sqrt(sum);
}

double exact_angle_deg(const Pose& pose) {
  const Quaternion q = quaternion_of(pose);
  return 2 * std::atan2(norm({q.x, q.y, q.z}), q.w) * kDegrees;
}

std::vector<RelativeError> relative_errors_as_tum(const Trajectory& truth, const Trajectory& estimate,
                                                  const RelativePairs& rule) {
  if (truth.empty() || estimate.empty()) return {};
  const std::vector<double> truth_s = stamps_of(truth);
  const double furthest_s = 2 * median_interval(truth_s);
  std::vector<RelativeError> errors;
  for (const auto& [from, to] : pairs_of(estimate, rule)) {
    const std::size_t truth_from = closest_index(truth_s, estimate[from].stamp_s);
    const std::size_t truth_to = closest_index(truth_s, estimate[to].stamp_s);
    if (std::abs(truth_s[truth_from] - estimate[from].stamp_s) > furthest_s ||
        std::abs(truth_s[truth_to] - estimate[to].stamp_s) > furthest_s)
      continue;
    const Pose estimated = estimate[to].world_from_camera.inverse() * estimate[from].world_from_camera;
    const Pose true_motion =
        truth[truth_to].world_from_camera.inverse() * truth[truth_from].world_from_camera;
    const Pose error = estimated.inverse() * true_motion;
    errors.push_back(
        {from, to, norm(error.translation), rotation_angle(error) * kDegrees, distance_from_identity(error)});
  }
  return errors;
}

std::vector<RelativeError> relative_errors_as_evo(const Trajectory& truth, const Trajectory& estimate,
                                                  const std::vector<Match>& matches, double scale) {
  const auto scaled = [&](std::size_t idx) {
    Pose pose = estimate[idx].world_from_camera;
    pose.translation = scale * pose.translation;
    return pose;
  };
  std::vector<RelativeError> errors;
  for (std::size_t i = 1; i < matches.size(); ++i) {
    const Match &from = matches[i - 1], &to = matches[i];
    const Pose true_motion =
        truth[from.truth_idx].world_from_camera.inverse() * truth[to.truth_idx].world_from_camera;
    const Pose error =
        true_motion.inverse() * (scaled(from.estimate_idx).inverse() * scaled(to.estimate_idx));
    errors.push_back({from.estimate_idx, to.estimate_idx, norm(error.translation), exact_angle_deg(error),
                      distance_from_identity(error)});
  }
  return errors;
}

}  // namespace sediment::tools
