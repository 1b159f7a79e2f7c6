#include <cmath>
#include <map>

#include "pipeline/artifacts/trajectory_file.hpp"
#include "tools/evaluate-trajectory/evaluation.hpp"
#include "tools/evaluate-trajectory/evaluation_text.hpp"
#include "tools/report/parts.hpp"

namespace sediment::report {
namespace {

namespace fs = std::filesystem;

/// A tenth of a millimetre is enough for a picture.
double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

Json poses_of(const Trajectory& trajectory) {
  Json poses = Json::array();
  for (const StampedPose& pose : trajectory) {
    const Vec3& t = pose.world_from_camera.translation;
    const Quaternion q = quaternion_of(pose.world_from_camera);
    poses.push_back(
        {rounded(t.x), rounded(t.y), rounded(t.z), rounded(q.x), rounded(q.y), rounded(q.z), rounded(q.w)});
  }
  return poses;
}

Json tracking_of(const fs::path& folder) {
  Json stamps = Json::array(), tracked = Json::array(), keyframes = Json::array(), matches = Json::array(),
       inliers = Json::array(), residuals = Json::array();
  for (const FrameTracking& frame : read_tracking(folder)) {
    stamps.push_back(frame.stamp);
    tracked.push_back(frame.state == TrackingState::tracked ? 1 : 0);
    keyframes.push_back(frame.keyframe ? 1 : 0);
    matches.push_back(frame.matches);
    inliers.push_back(frame.inliers);
    residuals.push_back(std::round(frame.residual_px * 1e3) / 1e3);
  }
  return {{"stamps", stamps},   {"tracked", tracked}, {"keyframes", keyframes},
          {"matches", matches}, {"inliers", inliers}, {"residual_px", residuals}};
}

/// The truth, moved into the world of the estimate, at the poses that have one, and the errors there.
Json errors_of(const Trajectory& truth, const tools::Evaluation& evaluation) {
  const Pose estimate_from_truth = evaluation.ate.alignment.truth_from_estimate.inverse();
  std::map<std::size_t, double> relative_m;
  if (!evaluation.rpe.empty())
    for (const tools::RelativeError& error : evaluation.rpe.front().errors)
      relative_m[error.from_idx] = error.translation_m;
  Json rows = Json::array();
  for (std::size_t i = 0; i < evaluation.ate.matches.size(); ++i) {
    const tools::Match& match = evaluation.ate.matches[i];
    const Vec3 at = estimate_from_truth * truth[match.truth_idx].world_from_camera.translation;
    const auto relative = relative_m.find(match.estimate_idx);
    Json row = {match.estimate_idx, rounded(at.x), rounded(at.y), rounded(at.z),
                std::round(evaluation.ate.error_m[i] * 1e6) / 1e6};
    row.push_back(relative == relative_m.end() ? Json() : Json(std::round(relative->second * 1e6) / 1e6));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

Json trajectory_part(const fs::path& folder, const fs::path& truth_file) {
  const Trajectory estimate = read_trajectory(folder);
  Json stamps = Json::array();
  for (const StampedPose& pose : estimate) stamps.push_back(pose.stamp);
  Json part = {{"stamps", stamps}, {"poses", poses_of(estimate)}, {"tracking", tracking_of(folder)}};
  if (truth_file.empty()) {
    part["not_evaluated"] = "the sequence names no ground truth";
    return part;
  }
  try {
    const GroundTruth truth = read_ground_truth(truth_file);
    const std::size_t frames = part["tracking"]["stamps"].size();
    const tools::Evaluation evaluation =
        tools::evaluate(truth, estimate, tools::FrameCount{frames, "tracking.json"});
    part["evaluation"] = tools::to_json(evaluation);
    part["errors"] = errors_of(truth.trajectory, evaluation);
  } catch (const std::exception& error) {
    part["not_evaluated"] = error.what();
  }
  return part;
}

}  // namespace sediment::report
