#include "tools/synthesize/shading.hpp"

#include <algorithm>
#include <cmath>

namespace sediment::synthetic {
namespace {

using Float3 = std::array<float, 3>;

Float3 float3(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
float dot(const Float3& a, const Float3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec3 rotate_back(const Pose& pose, Vec3 v) {
  const auto& r = pose.rotation;
  return {r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
          r[2] * v.x + r[5] * v.y + r[8] * v.z};
}

FaceView face_view(const Solid& solid, int face, const Pose& camera_from_solid) {
  const Vec3 corner = point_on(solid, face, 0, 0);
  const FaceRange range = face_range(solid, face);
  const SurfacePoint middle =
      surface_at(solid, point_on(solid, face, range.u_m / 2, (range.v_low_m + range.v_high_m) / 2));
  FaceView view{float3(camera_from_solid.rotate(middle.normal)),
                float3(camera_from_solid.rotate(middle.u_axis)),
                float3(camera_from_solid.rotate(middle.v_axis)), 0, 0};
  const Float3 origin = float3(camera_from_solid * corner);
  view.u_shift = -dot(origin, view.u_axis), view.v_shift = -dot(origin, view.v_axis);
  return view;
}

/// How far a pixel reaches on a plane: with the hit t * ray on the plane n, dt/dx = -t n.x / (n ray).
Footprint footprint_of(const FaceView& f, const Float3& ray, float depth_m, float pixel_angle) {
  // Seen edge-on the footprint has no bound: limited to 20 : 1.
  const float slope = 1 / std::min(dot(f.normal, ray), -0.05f), step = depth_m * pixel_angle;
  const float along_u = slope * dot(ray, f.u_axis), along_v = slope * dot(ray, f.v_axis);
  return {step * (f.u_axis[0] - f.normal[0] * along_u), step * (f.v_axis[0] - f.normal[0] * along_v),
          step * (f.u_axis[1] - f.normal[1] * along_u), step * (f.v_axis[1] - f.normal[1] * along_v)};
}

/// The face of a unit box that a ray hits: that of the coordinate that is largest there.
int face_hit(const Target& t, const Float3& ray, float depth_m) {
  int axis = 0;
  float largest = -1, value = 0;
  for (int i = 0; i < 3; ++i) {
    const float p = t.origin[i] +
                    depth_m * (t.linear[3 * i] * ray[0] + t.linear[3 * i + 1] * ray[1] + t.linear[3 * i + 2]);
    if (std::fabs(p) > largest) axis = i, largest = std::fabs(p), value = p;
  }
  return 2 * axis + (value > 0);
}

// What moves hides the lamps from what is below it: a soft round shadow, at its strongest near its feet.
float open_sky(const Moment& moment, Vec3 point) {
  double open = 1;
  for (const SoftShadow& s : moment.shadows) {
    const double dx = point.x - s.x, dy = point.y - s.y,
                 far2 = (dx * dx + dy * dy) / (s.radius_m * s.radius_m);
    if (far2 > 4 || point.z > s.top_m) continue;
    const double near = 1 - far2 / 4;
    open *= 1 - 0.45 * near * near * (1 - point.z / s.top_m);
  }
  return static_cast<float>(open);
}

/// Where a hit is on its solid.
struct Hit {
  int face;
  float u_m, v_m;
  Footprint footprint;
  Vec3 normal;  ///< world frame
};

Hit hit_on_box(const View& view, const SolidView& solid, const Float3& ray, float depth_m) {
  const int face = face_hit(solid.target, ray, depth_m);
  const FaceView& f = solid.faces[static_cast<std::size_t>(face)];
  // Column of the rotation: where the face's axis points in the world.
  const auto& r = solid.placed->world_from_solid.rotation;
  const auto axis = static_cast<std::size_t>(face / 2);
  const double sign = face % 2 ? 1 : -1;
  return {face,
          depth_m * dot(ray, f.u_axis) + f.u_shift,
          depth_m * dot(ray, f.v_axis) + f.v_shift,
          footprint_of(f, ray, depth_m, view.pixel_angle),
          {sign * r[axis], sign * r[axis + 3], sign * r[axis + 6]}};
}

Hit hit_on_round(const View& view, const SolidView& solid, const Float3& ray, float depth_m) {
  const Pose& frame = solid.camera_from_solid;
  const Vec3 point = double(depth_m) * Vec3{ray[0], ray[1], 1};
  const SurfacePoint at = surface_at(*solid.placed->solid, rotate_back(frame, point - frame.translation));
  const FaceView tangent{float3(frame.rotate(at.normal)), float3(frame.rotate(at.u_axis)),
                         float3(frame.rotate(at.v_axis)), 0, 0};
  return {at.face, at.u_m, at.v_m, footprint_of(tangent, ray, depth_m, view.pixel_angle),
          solid.placed->world_from_solid.rotate(at.normal)};
}

}  // namespace

View view_of(const Scene& scene, const Lighting& lighting, const Moment& moment,
             const Pose& world_from_camera, double pixel_angle) {
  View view{scene, lighting, moment, world_from_camera, static_cast<float>(pixel_angle), {}};
  const Pose camera_from_world = world_from_camera.inverse();
  view.solids.reserve(moment.solids.size());
  for (const PlacedSolid& placed : moment.solids) {
    const Pose camera_from_solid = camera_from_world * placed.world_from_solid;
    const Solid& solid = *placed.solid;
    SolidView seen{&placed,
                   camera_from_solid,
                   target_of(solid, camera_from_solid),
                   reach_of(solid, camera_from_solid),
                   {},
                   {}};
    if (solid.shape == Shape::box)
      for (int face = 0; face < kFaces; ++face)
        seen.faces[static_cast<std::size_t>(face)] = face_view(solid, face, camera_from_solid);
    if (placed.fixed_idx < 0) seen.air = lighting.in_air(placed.world_from_solid.translation);
    view.solids.push_back(seen);
  }
  return view;
}

Shade shade(const View& view, int solid_idx, float x, float y, float depth_m) {
  const SolidView& solid = view.solids[static_cast<std::size_t>(solid_idx)];
  const Float3 ray{x, y, 1};
  const bool flat = solid.target.shape == Shape::box;
  const Hit hit = flat ? hit_on_box(view, solid, ray, depth_m) : hit_on_round(view, solid, ray, depth_m);
  const int material_idx = solid.placed->solid->materials[static_cast<std::size_t>(hit.face)];
  const Material& material = view.scene.materials[static_cast<std::size_t>(material_idx)];
  const Rgb paint = material.tint * view.scene.textures[static_cast<std::size_t>(material.texture)].sample(
                                        hit.u_m, hit.v_m, hit.footprint);
  Rgb light = solid.placed->fixed_idx >= 0
                  ? view.lighting.on_face(solid.placed->fixed_idx, hit.face, hit.u_m, hit.v_m)
                  : light_from(solid.air, hit.normal);
  if (hit.normal.z > 0.3)
    light = open_sky(view.moment, view.world_from_camera * (double(depth_m) * Vec3{x, y, 1})) * light;
  const Rgb lit = paint * light;
  return {material.glow > 0 ? blend(lit, paint, material.glow) : lit, hit.face, hit.u_m, hit.v_m};
}

}  // namespace sediment::synthetic
