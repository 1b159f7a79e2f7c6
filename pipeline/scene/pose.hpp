#pragma once

#include <array>

#include "pipeline/scene/vec3.hpp"

namespace sediment {

/// Unit quaternion in the order of the TUM trajectory format: x y z w.
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// Rigid transform. A variable of this type is named `target_from_source`, so that composition reads as
/// cancellation: `world_from_camera * camera_from_object` is `world_from_object`.
struct Pose {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row-major, orthonormal, determinant 1
  Vec3 translation{};                                         ///< metres

  /// Rotates and translates a point of the source frame into the target frame.
  Vec3 operator*(Vec3 point) const { return rotate(point) + translation; }
  /// Rotates a direction, without the translation.
  Vec3 rotate(Vec3 direction) const {
    const auto& r = rotation;
    return {r[0] * direction.x + r[1] * direction.y + r[2] * direction.z,
            r[3] * direction.x + r[4] * direction.y + r[5] * direction.z,
            r[6] * direction.x + r[7] * direction.y + r[8] * direction.z};
  }
  Pose operator*(const Pose& right) const;
  Pose inverse() const;
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// The pose of a rotation (normalised here; throws std::invalid_argument if it is zero or not finite) and a
/// translation.
Pose pose_from(const Quaternion& rotation, Vec3 translation);

/// The rotation of a pose as a unit quaternion with w >= 0.
Quaternion quaternion_of(const Pose& pose);

/// Rotation by the length of `axis_angle_rad` about its direction (Rodrigues), no translation.
Pose rotation_from(Vec3 axis_angle_rad);

/// The rotation of a pose as an axis times an angle in radians, 0 .. pi: the inverse of rotation_from.
Vec3 rotation_vector(const Pose& pose);

/// Angle of the rotation in radians, 0 .. pi. Source: TUM's evaluate_rpe.py, arccos((trace - 1) / 2),
/// clamped.
double rotation_angle(const Pose& pose);

/// The pose at `fraction` (0 .. 1) between two: linear in translation, slerp in rotation.
Pose interpolate(const Pose& from, const Pose& to, double fraction);

}  // namespace sediment
