#include "pipeline/artifacts/trajectory_file.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/frame_json.hpp"
#include "pipeline/artifacts/text_table.hpp"

namespace sediment {
namespace {

constexpr const char* kTrackingFormat = "sediment-tracking 1";
constexpr double kAlike_m = 0.01, kAlike_rad = 0.0175;  ///< poses of a ground truth that are the same
constexpr const char* kColumns[8] = {"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};

StampedPose pose_from_row(const TextRow& row) {
  if (row.columns.size() != 8)
    throw std::runtime_error("expected 8 columns (timestamp tx ty tz qx qy qz qw), found " +
                             std::to_string(row.columns.size()));
  double v[8];
  for (int i = 0; i < 8; ++i) v[i] = expect_number(row.columns[i], kColumns[i]);
  return {std::string(row.columns[0]), v[0], pose_from({v[4], v[5], v[6], v[7]}, {v[1], v[2], v[3]})};
}

/// `may_replace(earlier, later)` decides about two poses with one stamp; false is an error.
template <class MayReplace>
Trajectory read_poses(const std::filesystem::path& file, const MayReplace& may_replace) {
  std::map<double, std::pair<int, StampedPose>> poses;  // by stamp, with the line
  read_rows(file, [&](const TextRow& row) {
    StampedPose pose = pose_from_row(row);
    const auto [place, fresh] = poses.try_emplace(pose.stamp_s, row.line, pose);
    if (fresh) return;
    if (!may_replace(place->second.second, pose))
      throw std::runtime_error("stamp " + pose.stamp + " is given twice (first in line " +
                               std::to_string(place->second.first) + ")");
    place->second.second = std::move(pose);
  });
  Trajectory trajectory;
  for (auto& [stamp_s, placed] : poses) trajectory.push_back(std::move(placed.second));
  return trajectory;
}

std::string line_of(const StampedPose& pose) {
  const Vec3 t = pose.world_from_camera.translation;
  const Quaternion q = quaternion_of(pose.world_from_camera);
  if (!std::isfinite(norm(t)) || !std::isfinite(q.x + q.y + q.z + q.w))
    throw std::runtime_error("the pose of frame " + pose.stamp + " is not finite");
  char text[256];
  std::snprintf(text, sizeof text, " %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", t.x, t.y, t.z, q.x, q.y, q.z,
                q.w);
  return pose.stamp + text;
}

}  // namespace

Trajectory read_tum_trajectory(const std::filesystem::path& file) {
  return read_poses(file, [](const StampedPose&, const StampedPose&) { return false; });
}

GroundTruth read_ground_truth(const std::filesystem::path& file) {
  GroundTruth truth;
  truth.trajectory = read_poses(file, [&](const StampedPose& earlier, const StampedPose& later) {
    const Pose difference = earlier.world_from_camera.inverse() * later.world_from_camera;
    const bool alike = norm(difference.translation) < kAlike_m && rotation_angle(difference) < kAlike_rad;
    truth.repeated += alike ? 1 : 0;
    return alike;
  });
  return truth;
}

void write_tum_trajectory(const std::filesystem::path& file, const Trajectory& trajectory) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : trajectory) text += line_of(pose);
  write_bytes(file, {text});
}

void write_trajectory(const std::filesystem::path& folder, const Trajectory& trajectory,
                      const std::vector<FrameTracking>& frames) {
  std::set<std::string> keyframe_stamps;
  std::vector<Json> list;
  for (const FrameTracking& frame : frames) {
    if (frame.keyframe) keyframe_stamps.insert(frame.stamp);
    list.push_back({{"stamp", frame.stamp},
                    {"state", frame.state == TrackingState::tracked ? "tracked" : "lost"},
                    {"keyframe", frame.keyframe},
                    {"matches", frame.matches},
                    {"inliers", frame.inliers},
                    {"residual_px", frame.residual_px},
                    {"segment", frame.segment}});
  }
  Trajectory keyframes;
  for (const StampedPose& pose : trajectory)
    if (keyframe_stamps.erase(pose.stamp) != 0) keyframes.push_back(pose);
  if (!keyframe_stamps.empty())
    throw std::runtime_error("keyframe " + *keyframe_stamps.begin() + " has no pose in the trajectory");
  write_tum_trajectory(folder / "trajectory.txt", trajectory);
  write_tum_trajectory(folder / "keyframes.txt", keyframes);
  write_frame_json(folder / "tracking.json", kTrackingFormat, list);
}

Trajectory read_trajectory(const std::filesystem::path& folder) {
  return read_tum_trajectory(folder / "trajectory.txt");
}

std::vector<FrameTracking> read_tracking(const std::filesystem::path& folder) {
  std::vector<FrameTracking> frames;
  read_frame_json(folder / "tracking.json", kTrackingFormat, [&](const std::string& stamp, const Json& json) {
    const auto state = json.at("state").get<std::string>();
    if (state != "tracked" && state != "lost") throw std::runtime_error("unknown state \"" + state + "\"");
    frames.push_back({stamp, state == "tracked" ? TrackingState::tracked : TrackingState::lost,
                      json.at("keyframe").get<bool>(), json.value("matches", 0), json.value("inliers", 0),
                      json.value("residual_px", 0.0), json.value("segment", -1)});
  });
  return frames;
}

Trajectory read_keyframes(const std::filesystem::path& folder) {
  return read_tum_trajectory(folder / "keyframes.txt");
}

}  // namespace sediment
