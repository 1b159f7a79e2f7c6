#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "stages/track/map.hpp"
#include "stages/track/matching.hpp"
#include "stages/track/parameters.hpp"
#include "stages/track/pose_estimation.hpp"

namespace sediment::track {

/// A frame after tracking. Its pose hangs on a keyframe, so that it follows when the map is adjusted.
struct TrackedFrame {
  double stamp_s = 0;
  std::shared_ptr<const FrameFeatures> features;
  bool tracked = false, keyframe = false;
  int reference_idx = -1;  ///< keyframe
  Pose camera_from_reference;
  int matches = 0, inliers = 0;
  double residual_px = 0;
};

/// Pose of a tracked frame in the world as the map is now.
Pose camera_from_world(const TrackedFrame& frame, const Map& map);

/// The front end: poses frame after frame against a map that grows on the way.
class Tracker {
 public:
  Tracker(const Pinhole& pinhole, const Parameters& parameters)
      : pinhole_(pinhole), parameters_(parameters) {}

  /// Frames must come in order of their time.
  void track(double stamp_s, std::shared_ptr<const FrameFeatures> features);

  Map& map() { return map_; }
  std::vector<TrackedFrame>& frames() { return frames_; }

 private:
  struct Found {
    PoseEstimate estimate;
    std::vector<Match> matches;  ///< inliers only
    int tried = 0;
  };

  bool start_map();
  std::optional<Pose> predicted_pose() const;
  std::optional<Found> follow_last_frame(const Pose& predicted) const;
  std::optional<Found> recover_from(int keyframe_idx) const;
  std::optional<Found> relocalise() const;
  std::optional<Found> match_local_map(const Found& start);
  Found solve(const std::vector<Match>& matches, const Pose& start) const;
  void accept(const Found& found);
  bool wants_keyframe(const Found& found) const;

  Pinhole pinhole_;
  Parameters parameters_;
  Map map_;
  std::vector<TrackedFrame> frames_;
  std::vector<Match> last_matches_;  ///< of the last tracked frame
  int last_tracked_ = -1;            ///< index into frames_
};

}  // namespace sediment::track
