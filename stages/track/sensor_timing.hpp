#pragma once

#include <vector>

#include "pipeline/scene/pose.hpp"

namespace sediment::track {

/// Velocity of a camera in its own frame.
struct Motion {
  Vec3 angular_rad_s, linear_m_s;
};

/// When a colour-and-depth camera really takes its pixels. A Kinect reads its colour image out row by row,
/// and its depth image is older or newer than the stamps say; on a camera that turns by 100 degrees a second,
/// 10 ms are ten pixels. Both numbers are found from the recording itself (adjust() of the whole map).
struct SensorTiming {
  double readout_s = 0;    ///< from the first row to the last; the stamp is that of the middle row
  double depth_lag_s = 0;  ///< depth is this much later than its stamp says, compared with colour
};

/// The pose after moving for `duration_s` (negative: before), as camera_from_camera: takes points of the
/// camera frame at the later time to the frame at time 0.
Pose moved(const Motion& motion, double duration_s);

/// Velocities by central differences between neighbours; zero where a neighbour has no pose or is more than
/// `max_gap_s` away.
std::vector<Motion> motions_of(const std::vector<double>& stamps_s,
                               const std::vector<const Pose*>& world_from_camera, double max_gap_s);

}  // namespace sediment::track
