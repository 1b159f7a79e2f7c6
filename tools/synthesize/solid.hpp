#pragma once

#include <array>
#include <cstdint>

#include "pipeline/scene/pose.hpp"

namespace sediment::synthetic {

/// Convex shapes that everything in the room is made of, each in a frame of its own.
enum class Shape : std::uint8_t {
  box,       ///< |x| <= size.x, |y| <= size.y, |z| <= size.z
  capsule,   ///< hull of balls of radius size.x at the origin and size.y at (0, 0, size.z), none inside the
             ///< other
  cylinder,  ///< radius size.x, z from 0 to size.z
};

/// Faces of a box in the order of `Solid::materials`. A cylinder has side (0), bottom (1), top (2); a capsule
/// one face.
enum Face : std::uint8_t { kLeft, kRight, kFront, kBack, kBottom, kTop };  // -x +x -y +y -z +z
inline constexpr int kFaces = 6;

/// One convex piece of a body.
struct Solid {
  Shape shape = Shape::box;
  Vec3 size;                            ///< metres, see Shape
  double flatten = 1;                   ///< scale of the y axis: a chest is a flattened capsule
  Pose body_from_solid;                 ///< where the solid is in its body
  std::array<int, kFaces> materials{};  ///< index into Scene::materials by face
};

/// A place on the surface of a solid.
struct SurfacePoint {
  int face = 0;
  float u_m = 0, v_m = 0;  ///< position on the face, metres from its corner
  Vec3 normal;             ///< outward unit normal, solid frame
  Vec3 u_axis, v_axis;     ///< directions in which u and v grow, solid frame, unit length
};

/// What is at a point of the surface given in the solid's frame (points slightly off it are moved onto it).
SurfacePoint surface_at(const Solid& solid, Vec3 point);

/// Extent of a face: u from 0, v from `v_low_m` (below 0 on a capsule, whose round end is above its axis).
/// For curved faces circumference and length.
struct FaceRange {
  double u_m = 0, v_low_m = 0, v_high_m = 0;
};
FaceRange face_range(const Solid& solid, int face);
int face_count(Shape shape);

/// The inverse of surface_at: the place (u, v) of a face in the solid's frame.
Vec3 point_on(const Solid& solid, int face, double u_m, double v_m);

}  // namespace sediment::synthetic
