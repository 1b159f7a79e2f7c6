#pragma once

#include <span>

#include "pipeline/scene/pose.hpp"
#include "pipeline/scene/vec3.hpp"

namespace sediment::project2d {

/// Points p with dot(normal, p) + offset_m = 0. The normal has length one.
struct Plane {
  Vec3 normal{0, 0, 1};
  double offset_m = 0;

  /// Signed distance, positive on the side the normal points to.
  double height_m(Vec3 point) const { return dot(normal, point) + offset_m; }
  Plane flipped() const { return {-normal, -offset_m}; }
};

/// A plane and how well points fit it.
struct PlaneFit {
  Plane plane;  ///< through the centroid; the sign of the normal means nothing
  Vec3 centroid;
  double rms_m = 0;         ///< across the plane
  double extent_rms_m = 0;  ///< along the direction in the plane in which the points spread less
};

/// Least squares. Needs a point.
PlaneFit fit_plane(std::span<const Vec3> points);

/// The transform of section 3.3.5 that lays the ground into z = 0, z up. The map's x axis is the world's x
/// axis (its z axis if x points up), projected; the origin is the foot of the world's origin.
Pose map_from_world(const Plane& ground);

}  // namespace sediment::project2d
