#include "tools/evaluate-trajectory/evaluation.hpp"

#include <cstdio>
#include <stdexcept>

namespace sediment::tools {
namespace {

constexpr std::size_t kFewestMatches = 3;  // two positions always align almost perfectly

std::string span_of(const Trajectory& trajectory) {
  return trajectory.front().stamp + " .. " + trajectory.back().stamp;
}

void require(const Trajectory& truth, const Trajectory& estimate, std::size_t matches, const char* rule) {
  if (matches >= kFewestMatches) return;
  throw std::runtime_error(
      "no error can be computed: " + std::to_string(matches) + " poses of the estimate (" +
      std::to_string(estimate.size()) + ", stamps " + span_of(estimate) + ") have a true one " + rule + " (" +
      std::to_string(truth.size()) + ", stamps " + span_of(truth) + "), and at least " +
      std::to_string(kFewestMatches) + " are needed" + (matches == 0 ? "; is it the same sequence?" : ""));
}

/// Positions of matched poses, truth and estimate.
std::pair<std::vector<Vec3>, std::vector<Vec3>> positions_of(const Trajectory& truth,
                                                             const Trajectory& estimate,
                                                             const std::vector<Match>& matches) {
  std::pair<std::vector<Vec3>, std::vector<Vec3>> positions;
  for (const Match& match : matches) {
    positions.first.push_back(truth[match.truth_idx].world_from_camera.translation);
    positions.second.push_back(estimate[match.estimate_idx].world_from_camera.translation);
  }
  return positions;
}

AbsoluteError absolute_error(const Trajectory& truth, const Trajectory& estimate) {
  AbsoluteError result;
  result.matches = match_as_tum(truth, estimate);
  require(truth, estimate, result.matches.size(), "within 0.02 s");
  const auto [true_positions, positions] = positions_of(truth, estimate, result.matches);
  result.alignment = align(true_positions, positions, false).value();
  for (std::size_t i = 0; i < positions.size(); ++i)
    result.error_m.push_back(norm(result.alignment * positions[i] - true_positions[i]));
  result.statistics = statistics_of(result.error_m);
  return result;
}

EvoErrors evo_ape(const Trajectory& truth, const Trajectory& estimate, const std::vector<Match>& matches,
                  const std::optional<Alignment>& alignment) {
  EvoErrors errors{alignment, {}, {}, {}};
  for (const Match& match : matches) {
    const Pose& true_pose = truth[match.truth_idx].world_from_camera;
    const Pose& estimated = estimate[match.estimate_idx].world_from_camera;
    const Pose error = true_pose.inverse() * (alignment ? *alignment * estimated : estimated);
    errors.translation_m.push_back(norm(error.translation));
    errors.rotation_deg.push_back(exact_angle_deg(error));
    errors.full.push_back(distance_from_identity(error));
  }
  return errors;
}

EvoErrors evo_rpe(const Trajectory& truth, const Trajectory& estimate, const std::vector<Match>& matches,
                  const std::optional<Alignment>& alignment) {
  EvoErrors errors{alignment, {}, {}, {}};
  for (const RelativeError& error :
       relative_errors_as_evo(truth, estimate, matches, alignment ? alignment->scale : 1)) {
    errors.translation_m.push_back(error.translation_m);
    errors.rotation_deg.push_back(error.rotation_deg);
    errors.full.push_back(error.full);
  }
  return errors;
}

void add_evo(Evaluation& result, const Trajectory& truth, const Trajectory& estimate) {
  result.evo_matches = match_as_evo(truth, estimate);
  require(truth, estimate, result.evo_matches.size(), "within 0.01 s");
  const auto [true_positions, positions] = positions_of(truth, estimate, result.evo_matches);
  result.ape = evo_ape(truth, estimate, result.evo_matches, std::nullopt);
  result.ape_aligned = evo_ape(truth, estimate, result.evo_matches, align(true_positions, positions, false));
  result.evo_rpe = evo_rpe(truth, estimate, result.evo_matches, std::nullopt);
  const auto scaled = align(true_positions, positions, true);
  if (!scaled) return;
  result.ape_scaled = evo_ape(truth, estimate, result.evo_matches, scaled);
  result.evo_rpe_scaled = evo_rpe(truth, estimate, result.evo_matches, scaled);
}

void add_rpe(Evaluation& result, const Trajectory& truth, const Trajectory& estimate,
             const RelativePairs& rule, const char* name) {
  RelativeErrors errors{name, relative_errors_as_tum(truth, estimate, rule), {}, {}, {}};
  if (errors.errors.size() < 2) return;
  std::vector<double> translation_m, rotation_deg, full;
  for (const RelativeError& error : errors.errors) {
    translation_m.push_back(error.translation_m);
    rotation_deg.push_back(error.rotation_deg);
    full.push_back(error.full);
  }
  errors.translation_m = statistics_of(translation_m);
  errors.rotation_deg = statistics_of(rotation_deg);
  errors.full = statistics_of(full);
  result.rpe.push_back(std::move(errors));
}

}  // namespace

std::optional<double> Evaluation::coverage() const {
  if (!frames) return std::nullopt;
  return static_cast<double>(estimate_poses) / static_cast<double>(frames->frames);
}

Evaluation evaluate(const GroundTruth& ground_truth, const Trajectory& estimate,
                    const std::optional<FrameCount>& frames) {
  const Trajectory& truth = ground_truth.trajectory;
  if (truth.empty()) throw std::runtime_error("the truth holds no pose");
  if (estimate.empty()) throw std::runtime_error("the estimate holds no pose");
  if (frames && frames->frames < estimate.size())
    throw std::runtime_error("the estimate has " + std::to_string(estimate.size()) +
                             " poses, but there are only " + std::to_string(frames->frames) + " frames (" +
                             frames->source + ")");
  Evaluation result;
  result.truth_poses = truth.size();
  result.truth_repeated = ground_truth.repeated;
  result.estimate_poses = estimate.size();
  result.frames = frames;
  result.ate = absolute_error(truth, estimate);
  add_rpe(result, truth, estimate, {RelativePairs::Rule::seconds, 1}, "1 s");
  add_rpe(result, truth, estimate, {RelativePairs::Rule::frames, 1}, "1 frame");
  add_rpe(result, truth, estimate, {RelativePairs::Rule::random}, "10000 random");
  add_evo(result, truth, estimate);
  return result;
}

}  // namespace sediment::tools
