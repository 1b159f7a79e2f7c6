#include "tools/synthesize/shading.hpp"

#include <algorithm>
#include <cmath>

namespace sediment::synthetic {
namespace {

// Corners of the room and the feet of things on the floor get less light: one minus the part of the half
// space that a wall at distance d takes, with a soft reach of a quarter of a metre.
double corner_darkening(const Scene& scene, Vec3 p, Vec3 n) {
  const double distance[6] = {p.x - scene.room_low.x,  scene.room_high.x - p.x, p.y - scene.room_low.y,
                              scene.room_high.y - p.y, p.z - scene.room_low.z,  scene.room_high.z - p.z};
  const double facing[6] = {n.x, -n.x, n.y, -n.y, n.z, -n.z};
  double open = 1;
  for (int wall = 0; wall < 6; ++wall) {
    if (facing[wall] > 0.5) continue;  // the surface looks away from that wall
    const double reach = 1 + std::max(distance[wall], 0.0) / 0.25;
    open *= 1 - 0.3 / (reach * reach);
  }
  return open;
}

// Change of the ray's hit on the plane with `normal` (camera frame) per pixel along one image axis.
Vec3 hit_change(Vec3 ray, double depth_m, Vec3 normal, double along, Vec3 axis, double pixel_angle) {
  // Seen edge-on the footprint has no bound: limited to 20 : 1.
  const double facing = std::min(dot(normal, ray), -0.05);
  return depth_m * pixel_angle * (axis - (along / facing) * ray);
}

}  // namespace

Rgb light_at(const Scene& scene, Vec3 point, Vec3 normal) {
  Rgb sum = static_cast<float>(0.85 + 0.15 * normal.z) * scene.ambient;
  for (const Lamp& lamp : scene.lamps) {
    const Vec3 to_lamp = lamp.position - point;
    const double distance2 = dot(to_lamp, to_lamp), distance = std::sqrt(distance2);
    // Wrapped Lambert: a lamp of some size lights surfaces a little beyond the edge.
    const double cosine = std::max(0.0, (dot(normal, to_lamp) / distance + 0.2) / 1.2);
    sum = sum + static_cast<float>(cosine / (1 + 0.35 * distance2)) * lamp.power;
  }
  return static_cast<float>(corner_darkening(scene, point, normal)) * sum;
}

Shade shade(const Scene& scene, const PlacedSolid& placed, const Pose& world_from_camera, double x, double y,
            double depth_m, double pixel_angle) {
  const Vec3 ray{x, y, 1};
  const Vec3 world = world_from_camera * (depth_m * ray);
  const Pose& frame = placed.world_from_solid;
  const auto into_solid = [&](Vec3 v) {
    const auto& r = frame.rotation;
    return Vec3{r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
                r[2] * v.x + r[5] * v.y + r[8] * v.z};
  };
  const SurfacePoint at = surface_at(*placed.solid, into_solid(world - frame.translation));
  const auto into_camera = [&](Vec3 v) {
    const Vec3 w = frame.rotate(v);
    const auto& r = world_from_camera.rotation;
    return Vec3{r[0] * w.x + r[3] * w.y + r[6] * w.z, r[1] * w.x + r[4] * w.y + r[7] * w.z,
                r[2] * w.x + r[5] * w.y + r[8] * w.z};
  };
  const Vec3 normal = into_camera(at.normal), u_axis = into_camera(at.u_axis),
             v_axis = into_camera(at.v_axis);
  const Vec3 right = hit_change(ray, depth_m, normal, normal.x, {1, 0, 0}, pixel_angle);
  const Vec3 down = hit_change(ray, depth_m, normal, normal.y, {0, 1, 0}, pixel_angle);
  const Footprint footprint{static_cast<float>(dot(right, u_axis)), static_cast<float>(dot(right, v_axis)),
                            static_cast<float>(dot(down, u_axis)), static_cast<float>(dot(down, v_axis))};
  const Material& material = scene.materials[placed.solid->materials[at.face]];
  const Rgb paint = material.tint * scene.textures[material.texture].sample(at.u_m, at.v_m, footprint);
  const Rgb lit = paint * light_at(scene, world, frame.rotate(at.normal));
  return {material.glow > 0 ? blend(lit, paint, material.glow) : lit, at.face, at.u_m, at.v_m};
}

}  // namespace sediment::synthetic
