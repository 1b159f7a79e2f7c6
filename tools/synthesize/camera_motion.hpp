#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "pipeline/scene/pose.hpp"

namespace sediment::synthetic {

/// Pose of the camera over time, in optical convention: z forward, x right, y down.
using CameraMotion = std::function<Pose(double time_s)>;

/// The pose of a camera at `position`: `yaw` 0 looks to +y and grows to the right, `pitch` grows upward,
/// `roll` turns the camera clockwise about its axis of sight.
Pose looking(Vec3 position, double yaw_rad, double pitch_rad, double roll_rad);

/// Held by hand, towards the desks: swings slowly by a quarter of a metre and trembles.
CameraMotion handheld(std::uint64_t seed, Vec3 position, double yaw_rad, double pitch_rad);
/// Held by hand at one place and turned about all axes.
CameraMotion turning(std::uint64_t seed, Vec3 position, double yaw_rad, double pitch_rad);

/// What an accelerometer fixed to the camera measures, in the camera frame, m/s^2: acceleration minus
/// gravity. At rest it points up with 9.81.
Vec3 specific_force(const CameraMotion& motion, double time_s);

}  // namespace sediment::synthetic
