#pragma once

#include "tools/evaluate-map/nearest_point.hpp"
#include "tools/evaluate-map/voxel_set.hpp"
#include "tools/truth/true_sequence.hpp"

namespace sediment::tools {

/// Points of what moves and of what moved at another time, in the world of the truth: one in each cell of 1
/// cm, as the same things are seen in many frames.
struct MoverPoints {
  std::vector<Vec3> dynamic;  ///< of dynamic pixels
  std::vector<Vec3> resting;  ///< of objects that move at some time, in frames in which they rest
};

/// Back-projects with the true poses every `pixel_step`-th pixel up to `max_depth_m`. Objects at rest are
/// known only where the truth has instances.
MoverPoints mover_points(const TrueSequence& truth, double max_depth_m, int pixel_step);

/// What is truly there, in cells of one size.
struct TrueVoxels {
  VoxelSet still;    ///< with a point of a surface that never moves
  VoxelSet surface;  ///< those and the cells of objects at rest
  VoxelSet dynamic;  ///< hit by a dynamic pixel and not within one cell (of 26) of `surface`
};
TrueVoxels true_voxels(const LabelledCloud& static_cloud, const MoverPoints& movers, double side_m);

/// Space that was seen to be free: a point is, if in at least `least_frames` frames the depth measured behind
/// it is larger by a margin that grows with the noise of the depth.
class FreeSpace {
 public:
  /// At most `max_frames` frames, evenly spread, are kept in memory.
  FreeSpace(const TrueSequence& truth, double voxel_side_m, int least_frames = 2,
            std::size_t max_frames = 120);
  /// Whether the point was seen through.
  bool contains(Vec3 point) const;
  /// Where the frames were taken.
  std::vector<Vec3> viewpoints() const;

 private:
  struct View {
    Pose camera_from_world;
    cv::Mat depth;
  };
  Camera camera_;
  double margin_m_;
  int least_frames_;
  std::vector<View> views_;
};

}  // namespace sediment::tools
