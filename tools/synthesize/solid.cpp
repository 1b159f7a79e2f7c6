#include "tools/synthesize/solid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sediment::synthetic {
namespace {

struct FaceAxes {
  Vec3 normal, u, v;  // u to the right and v down for one who looks at the face from outside
};
constexpr FaceAxes kBoxFaces[kFaces] = {
    {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},  {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
    {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}},   {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}}};

double extent_along(const Vec3& half, const Vec3& axis) {
  return std::abs(dot(half, axis));
}

SurfacePoint box_surface(const Solid& solid, Vec3 p) {
  const double outside[3] = {std::abs(p.x) - solid.size.x, std::abs(p.y) - solid.size.y,
                             std::abs(p.z) - solid.size.z};
  const double coordinate[3] = {p.x, p.y, p.z};
  const int axis = static_cast<int>(std::max_element(outside, outside + 3) - outside);
  SurfacePoint at;
  at.face = 2 * axis + (coordinate[axis] > 0 ? 1 : 0);
  const FaceAxes& axes = kBoxFaces[at.face];
  at.normal = axes.normal, at.u_axis = axes.u, at.v_axis = axes.v;
  at.u_m = static_cast<float>(dot(p, axes.u) + extent_along(solid.size, axes.u));
  at.v_m = static_cast<float>(dot(p, axes.v) + extent_along(solid.size, axes.v));
  return at;
}

// The angle grows counter-clockwise seen from above, which is to the right for one who looks from outside.
SurfacePoint round_surface(const Solid& solid, Vec3 p) {
  SurfacePoint at;
  const double length_m = solid.size.z;
  p.y /= solid.flatten;
  const double radial = std::max(std::sqrt(p.x * p.x + p.y * p.y), 1e-9);
  const Vec3 outward{p.x / radial, p.y / radial, 0};
  const double mean_radius =
      solid.shape == Shape::cylinder ? solid.size.x : (solid.size.x + solid.size.y) / 2;
  at.u_m = static_cast<float>((std::atan2(p.y, p.x) + std::numbers::pi) * mean_radius);
  at.v_m = static_cast<float>(length_m - p.z);
  at.u_axis = {-outward.y, outward.x, 0};
  at.v_axis = {0, 0, -1};
  if (solid.shape == Shape::cylinder) {
    const double over_side = radial - solid.size.x, over_cap = std::max(-p.z, p.z - length_m);
    at.normal = outward;
    if (over_cap > over_side) {
      at.face = p.z > length_m / 2 ? 2 : 1;
      at.normal = {0, 0, at.face == 2 ? 1.0 : -1.0};
      at.u_m = static_cast<float>(p.x + solid.size.x), at.v_m = static_cast<float>(solid.size.x - p.y);
      at.u_axis = {1, 0, 0}, at.v_axis = {0, -1, 0};
    }
  } else {
    const double slope = (solid.size.x - solid.size.y) / length_m, cosine = std::sqrt(1 - slope * slope);
    // Foot of the surface normal on the axis.
    const double foot = std::clamp(p.z - radial * slope / cosine, 0.0, length_m);
    at.normal = normalized({p.x, p.y, p.z - foot});
    const double out = std::sqrt(at.normal.x * at.normal.x + at.normal.y * at.normal.y);
    at.v_axis = {outward.x * at.normal.z, outward.y * at.normal.z, -out};
  }
  if (solid.flatten != 1) at.normal = normalized({at.normal.x, at.normal.y / solid.flatten, at.normal.z});
  return at;
}

}  // namespace

SurfacePoint surface_at(const Solid& solid, Vec3 point) {
  return solid.shape == Shape::box ? box_surface(solid, point) : round_surface(solid, point);
}

int face_count(Shape shape) {
  return shape == Shape::box ? 6 : shape == Shape::cylinder ? 3 : 1;
}

FaceRange face_range(const Solid& solid, int face) {
  if (solid.shape == Shape::box)
    return {2 * extent_along(solid.size, kBoxFaces[face].u), 0,
            2 * extent_along(solid.size, kBoxFaces[face].v)};
  if (face > 0) return {2 * solid.size.x, 0, 2 * solid.size.x};
  if (solid.shape == Shape::cylinder) return {2 * std::numbers::pi * solid.size.x, 0, solid.size.z};
  return {std::numbers::pi * (solid.size.x + solid.size.y), -solid.size.y, solid.size.z + solid.size.x};
}

Vec3 point_on(const Solid& solid, int face, double u_m, double v_m) {
  if (solid.shape == Shape::box) {
    const FaceAxes& axes = kBoxFaces[face];
    return extent_along(solid.size, axes.normal) * axes.normal +
           (u_m - extent_along(solid.size, axes.u)) * axes.u +
           (v_m - extent_along(solid.size, axes.v)) * axes.v;
  }
  if (face > 0)
    return {u_m - solid.size.x, solid.flatten * (solid.size.x - v_m), face == 2 ? solid.size.z : 0};
  const double circumference = face_range(solid, face).u_m;
  const double angle = 2 * std::numbers::pi * u_m / circumference - std::numbers::pi;
  const double z = solid.size.z - v_m;
  double radius = solid.size.x;
  if (solid.shape == Shape::capsule) {
    const double slope = (solid.size.x - solid.size.y) / solid.size.z, cosine = std::sqrt(1 - slope * slope);
    const double low = solid.size.x * slope, high = solid.size.z + solid.size.y * slope;
    if (z < low)
      radius = std::sqrt(std::max(0.0, solid.size.x * solid.size.x - z * z));
    else if (z > high)
      radius =
          std::sqrt(std::max(0.0, solid.size.y * solid.size.y - (z - solid.size.z) * (z - solid.size.z)));
    else
      radius = (solid.size.x - slope * z) / cosine;
  }
  return {radius * std::cos(angle), solid.flatten * radius * std::sin(angle), z};
}

}  // namespace sediment::synthetic
