#include "tools/synthesize/shading.hpp"

#include <algorithm>

namespace sediment::synthetic {
namespace {

Vec3 rotate_back(const Pose& pose, Vec3 v) {
  const auto& r = pose.rotation;
  return {r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
          r[2] * v.x + r[5] * v.y + r[8] * v.z};
}

// Change of the ray's hit on the plane with `normal` (camera frame) per pixel along one image axis.
Vec3 hit_change(Vec3 ray, double depth_m, Vec3 normal, double along, Vec3 axis, double pixel_angle) {
  // Seen edge-on the footprint has no bound: limited to 20 : 1.
  const double facing = std::min(dot(normal, ray), -0.05);
  return depth_m * pixel_angle * (axis - (along / facing) * ray);
}

// What moves hides the lamps from what is below it: a soft round shadow, at its strongest near its feet.
float open_sky(const Moment& moment, Vec3 point, double up) {
  double open = 1;
  if (up < 0.3) return 1;
  for (const SoftShadow& s : moment.shadows) {
    const double dx = point.x - s.x, dy = point.y - s.y,
                 far2 = (dx * dx + dy * dy) / (s.radius_m * s.radius_m);
    if (far2 > 4 || point.z > s.top_m) continue;
    const double near = 1 - far2 / 4;
    open *= 1 - 0.45 * near * near * (1 - point.z / s.top_m);
  }
  return static_cast<float>(open);
}

}  // namespace

Shade shade(const View& view, int solid_idx, double x, double y, double depth_m) {
  const PlacedSolid& placed = view.moment.solids[static_cast<std::size_t>(solid_idx)];
  const Vec3 ray{x, y, 1};
  const Pose& frame = view.camera_from_solid[static_cast<std::size_t>(solid_idx)];
  const SurfacePoint at = surface_at(*placed.solid, rotate_back(frame, depth_m * ray - frame.translation));
  const Vec3 normal = frame.rotate(at.normal), u_axis = frame.rotate(at.u_axis),
             v_axis = frame.rotate(at.v_axis);
  const Vec3 right = hit_change(ray, depth_m, normal, normal.x, {1, 0, 0}, view.pixel_angle);
  const Vec3 down = hit_change(ray, depth_m, normal, normal.y, {0, 1, 0}, view.pixel_angle);
  const Footprint footprint{static_cast<float>(dot(right, u_axis)), static_cast<float>(dot(right, v_axis)),
                            static_cast<float>(dot(down, u_axis)), static_cast<float>(dot(down, v_axis))};
  const Material& material =
      view.scene
          .materials[static_cast<std::size_t>(placed.solid->materials[static_cast<std::size_t>(at.face)])];
  const Rgb paint = material.tint * view.scene.textures[static_cast<std::size_t>(material.texture)].sample(
                                        at.u_m, at.v_m, footprint);
  const Vec3 world = view.world_from_camera * (depth_m * ray),
             outward = placed.world_from_solid.rotate(at.normal);
  const bool fixed = placed.fixed_idx >= 0;
  const Rgb light = fixed ? view.lighting.on_face(placed.fixed_idx, at.face, at.u_m, at.v_m)
                          : view.lighting.in_air(world, outward);
  const Rgb lit = open_sky(view.moment, world, outward.z) * paint * light;
  return {material.glow > 0 ? blend(lit, paint, material.glow) : lit, at.face, at.u_m, at.v_m};
}

}  // namespace sediment::synthetic
