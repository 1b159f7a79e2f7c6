#pragma once

#include <memory>
#include <vector>

#include "pipeline/scene/pose.hpp"
#include "stages/track/dense_frame.hpp"
#include "stages/track/features.hpp"

namespace sediment::track {

/// A feature of a keyframe.
struct Sighting {
  int keyframe_idx = 0, feature_idx = 0;
};

/// A landmark.
struct MapPoint {
  Vec3 position;            ///< world frame, metres
  Vec3 viewing_direction;   ///< mean unit vector from the keyframes' centres to the point
  Descriptor descriptor{};  ///< the one nearest to all the others
  double min_distance_m = 0, max_distance_m = 0;  ///< range over which the pyramid shows it alike
  std::vector<Sighting> sightings;                ///< ascending by keyframe, one a keyframe
  int first_keyframe_idx = 0;
  int expected = 0, found = 0;  ///< frames that should have seen it, and did
  bool removed = false;
};

/// A frame whose sightings hold the map together.
struct Keyframe {
  int frame_idx = 0;
  Pose world_from_camera;
  std::shared_ptr<const FrameFeatures> features;
  std::shared_ptr<const DenseFrame> dense;
  std::vector<int> point_ids;  ///< per feature, -1 = none
  double noise_scale = 1;      ///< of its measurements, as PoseEstimate
  int segment = 0;             ///< keyframes of different segments have nothing in common, not even the world
};

/// How two keyframes lie to each other by the alignment of their whole images: what holds the map together
/// where there are few landmarks.
struct Link {
  int from_idx = 0, to_idx = 0;  ///< keyframes
  Pose to_from_from;
  std::array<double, 36> information{};  ///< of its error: rotation on the left, then translation
};

/// Landmarks and the keyframes that see them (ORB-SLAM's map: Mur-Artal and Tardos, T-RO 2017). Identifiers
/// are indices and never reused, so that every iteration has a fixed order.
class Map {
 public:
  std::vector<MapPoint> points;
  std::vector<Keyframe> keyframes;
  std::vector<Link> links;

  /// Adds the sighting to the point and the point to the keyframe.
  void connect(int point_id, Sighting sighting);
  void disconnect(int point_id, int keyframe_idx);
  int add_point(Vec3 position, Sighting first);
  /// Takes the point out of every keyframe.
  void remove_point(int point_id);
  /// `kept` takes over the sightings of `given_up` in keyframes where it has none.
  void merge_points(int kept, int given_up);
  /// Recomputes viewing direction and range from the sightings.
  void refresh_geometry(int point_id);
  /// The same and the descriptor: after a change of the sightings.
  void refresh_point(int point_id);
  bool sees(int keyframe_idx, int point_id) const;
  const Descriptor& descriptor(Sighting sighting) const {
    return keyframes[sighting.keyframe_idx].features->descriptor(sighting.feature_idx);
  }

  /// Keyframes that share at least `least` points with keyframe `keyframe_idx`: (shared, index), most first.
  std::vector<std::pair<int, int>> covisible(int keyframe_idx, int least) const;
};

}  // namespace sediment::track
