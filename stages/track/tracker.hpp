#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "stages/track/dense_alignment.hpp"
#include "stages/track/map.hpp"
#include "stages/track/parameters.hpp"
#include "stages/track/place_finding.hpp"

namespace sediment::track {

/// A frame after tracking. Its pose hangs on a keyframe, so that it follows when the map is adjusted.
struct TrackedFrame {
  double stamp_s = 0;
  std::shared_ptr<const FrameFeatures> features;
  std::shared_ptr<const FrameFeatures>
      waiting;  ///< on dynamic pixels: none use them in the front end; may be null
  std::shared_ptr<const DenseFrame> dense;
  bool tracked = false, keyframe = false;
  int reference_idx = -1;  ///< keyframe
  Pose camera_from_reference;
  int matches = 0, inliers = 0;
  double residual_px = 0;
  double deviation_rad = 0, deviation_m = 0;  ///< as PoseEstimate
  Pose world_from_camera_then;                ///< as the front end had it at that time
};

/// What tracking takes from a frame's images.
struct View {
  std::shared_ptr<const FrameFeatures> features;
  std::shared_ptr<const FrameFeatures> waiting;  ///< see TrackedFrame
  std::shared_ptr<const DenseFrame> dense;
};

/// Pose of a tracked frame in the world as the map is now.
Pose camera_from_world(const TrackedFrame& frame, const Map& map);

/// The front end: poses frame after frame against a map that grows on the way.
class Tracker {
 public:
  /// `dense_camera` must outlive the tracker.
  Tracker(const Pinhole& pinhole, const DenseCamera& dense_camera, const Parameters& parameters)
      : pinhole_(pinhole), dense_camera_(dense_camera), parameters_(parameters) {}

  /// Frames must come in order of their time.
  void track(double stamp_s, const View& view);

  Map& map() { return map_; }
  const Map& map() const { return map_; }
  std::vector<TrackedFrame>& frames() { return frames_; }
  const std::vector<TrackedFrame>& frames() const { return frames_; }

 private:
  using Found = Located;

  bool start_map();
  bool wants_segment() const;
  std::optional<Pose> predicted_pose() const;
  std::optional<Found> find_nearby(const Pose& predicted);
  std::optional<Pose> aligned_to_last(const Pose& predicted);
  std::optional<Found> align_to_keyframe(const Pose& predicted);
  void link(int from_idx, int to_idx);
  const DenseImages& images_of(int keyframe_idx);
  const DenseImages& current_images();
  const DenseImages& last_images();
  std::optional<Found> follow_last_frame(const Pose& predicted) const;
  std::optional<Found> relocalise();
  std::optional<Found> match_local_map(const Found& start);
  void accept(const Found& found);
  bool wants_keyframe(const Found& found) const;

  Pinhole pinhole_;
  const DenseCamera& dense_camera_;
  Parameters parameters_;
  Map map_;
  std::vector<TrackedFrame> frames_;
  std::vector<Match> last_matches_;  ///< of the last tracked frame
  int last_tracked_ = -1;            ///< index into frames_
  std::shared_ptr<const DenseImages> images_,
      last_images_;                             ///< of this frame, of the last; made when asked for
  std::map<int, DenseImages> keyframe_images_;  ///< of the few keyframes aligned to last
  std::optional<PlaceIndex> places_;            ///< of the keyframes, made when the way is lost
  int segments_ = 0;
};

}  // namespace sediment::track
