#pragma once

#include <vector>

#include "stages/track/pose_estimation.hpp"

namespace sediment::track::test {

inline Pinhole test_pinhole() {
  Pinhole pinhole{525, 525, 320, 240};
  pinhole.right = 640;
  pinhole.bottom = 480;
  return pinhole;
}

/// Points 2 to 5 m ahead of the origin, the same in every call (a linear congruential sequence).
inline std::vector<Vec3> scattered_points(int count) {
  std::vector<Vec3> points;
  unsigned state = 12345;
  const auto next = [&state] { return ((state = state * 1664525u + 1013904223u) >> 8) / double(1u << 24); };
  for (int i = 0; i < count; ++i) {
    const double z = 2 + 3 * next();
    points.push_back({(next() - 0.5) * z, (next() - 0.5) * 0.7 * z, z});
  }
  return points;
}

/// Exact measurements of points.
inline std::vector<Correspondence> observe(const std::vector<Vec3>& points, const Pose& camera_from_world,
                                           const Pinhole& pinhole) {
  std::vector<Correspondence> seen;
  for (const Vec3& point : points) {
    const Vec3 p = camera_from_world * point;
    const Pixel pixel = pinhole.project(p);
    Measurement measurement;
    measurement.u_px = pixel.u;
    measurement.v_px = pixel.v;
    measurement.inverse_depth = 1 / p.z;
    measurement.depth_weight = 1 / pinhole.depth_sigma;
    seen.push_back({point, measurement});
  }
  return seen;
}

}  // namespace sediment::track::test
