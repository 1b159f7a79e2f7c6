#pragma once

#include <vector>

#include "pipeline/scene/pose.hpp"

namespace sediment::track {

/// A pose as measured, and how well.
struct MeasuredPose {
  double stamp_s = 0;
  Pose world_from_camera;
  double deviation_rad = 0,
         deviation_m = 0;  ///< of the rotation, of the camera's centre; up to a common factor of three
};

/// The poses that are likeliest if the errors of the measured ones are independent from frame to frame and
/// the camera's velocity drifts as a random walk (white-noise acceleration; Barfoot, State Estimation for
/// Robotics, 2017), by a Kalman filter and the smoother of Rauch, Tung and Striebel (1965). How strongly it
/// drifts is learned from the poses themselves: the value under which they are likeliest (Wahba 1985), for
/// rotation and for the centre apart. So poses that are exact, or far apart in time, stay as they are. In
/// order of time; fewer than ten poses stay as they are.
std::vector<Pose> smoothed(const std::vector<MeasuredPose>& poses);

}  // namespace sediment::track
