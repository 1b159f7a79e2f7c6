#include "tools/synthesize/emitters.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/synthesize/ray_tile.hpp"

namespace sediment::synthetic {
namespace {

/// An emitter as a camera that looks along its normal, and everything fixed as seen from it.
struct Viewpoint {
  Emitter emitter;
  Pose emitter_from_world;
  std::vector<Target> targets;
  std::vector<Reach> reaches;
};

Pose pose_along(const Vec3& position, const Vec3& normal) {
  const Vec3 side = std::abs(normal.x) > 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 y = normalized(cross(normal, side)), x = cross(y, normal);
  Pose pose;
  pose.rotation = {x.x, y.x, normal.x, x.y, y.y, normal.y, x.z, y.z, normal.z};
  pose.translation = position;
  return pose;
}

std::vector<Viewpoint> viewpoints_of(const Scene& scene) {
  std::vector<Viewpoint> views;
  for (const Emitter& emitter : emitters_of(scene)) {
    Viewpoint view{emitter, pose_along(emitter.position, emitter.normal).inverse(), {}, {}};
    for (const Body& body : scene.bodies)
      for (const Solid& solid : body.solids) {
        if (body.mobility != Mobility::fixed) continue;
        const Pose emitter_from_solid = view.emitter_from_world * solid.body_from_solid;
        view.targets.push_back(target_of(solid, emitter_from_solid));
        view.reaches.push_back(reach_of(solid, emitter_from_solid));
      }
    views.push_back(std::move(view));
  }
  return views;
}

/// Calls `arrived(place, direction to the emitter, strength)` for each of up to 256 places that sees the
/// emitter.
template <class Arrived>
void shine(const Viewpoint& view, std::span<const Vec3> places, const Arrived& arrived) {
  RayTile tile;
  std::array<Vec3, RayTile::kRays> local{};
  for (std::size_t i = 0; i < RayTile::kRays; ++i) {
    local[i] = view.emitter_from_world * places[std::min(i, places.size() - 1)];
    // Places behind the emitter get a ray that is not looked at.
    const bool ahead = local[i].z > 1e-3;
    tile.x[i] = ahead ? static_cast<float>(local[i].x / local[i].z) : 0;
    tile.y[i] = ahead ? static_cast<float>(local[i].y / local[i].z) : 0;
    tile.depth_m[i] = ahead ? static_cast<float>(local[i].z) : 0;
  }
  tile.start_before_depth(static_cast<int>(places.size()));
  for (std::size_t k = 0; k < view.targets.size(); ++k)
    cast(view.targets[k], view.reaches[k], static_cast<std::int32_t>(k), tile);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (local[i].z < 1e-3 || tile.depth_m[i] < 0.995f * static_cast<float>(local[i].z) - 0.004f) continue;
    const Vec3 to_emitter = view.emitter.position - places[i];
    const double distance2 = dot(to_emitter, to_emitter), distance = std::sqrt(distance2);
    const Vec3 direction = to_emitter / distance;
    const double strength =
        -dot(direction, view.emitter.normal) / std::max(distance2, view.emitter.least_distance2);
    arrived(i, direction, strength);
  }
}

// A grid of points on one side of the room: `corner` and its two edges.
void add_wall(std::vector<Emitter>& emitters, Vec3 corner, Vec3 u, Vec3 v, Vec3 normal, int across, int up,
              Rgb power) {
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < up; ++j) {
      // Every other row is shifted: fewer emitters in line with edges.
      const double shift = j % 2 == 0 ? 0.35 : 0.65;
      const Vec3 at = corner + ((i + shift) / across) * u + ((j + 0.5) / up) * v;
      emitters.push_back({at + 0.01 * normal, normal, (1.f / static_cast<float>(across * up)) * power, 0.6});
    }
}

}  // namespace

std::vector<Emitter> emitters_of(const Scene& scene) {
  std::vector<Emitter> emitters;
  for (const Lamp& lamp : scene.lamps)
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 2; ++j)
        emitters.push_back({lamp.position + Vec3{lamp.width_m * ((i + 0.5) / 5 - 0.5),
                                                 lamp.depth_m * ((j + 0.5) / 2 - 0.5), 0},
                            {0, 0, -1},
                            0.1f * lamp.power,
                            0.05});
  const Vec3 low = scene.room_low, size = scene.room_high - scene.room_low;
  const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  const Rgb& back = scene.thrown_back;
  add_wall(emitters, low, x, y, {0, 0, 1}, 4, 4, 0.5f * back);
  add_wall(emitters, low + z, x, y, {0, 0, -1}, 4, 4, 1.1f * back);
  add_wall(emitters, low, x, z, {0, 1, 0}, 4, 2, 0.7f * back);
  add_wall(emitters, low + y, x, z, {0, -1, 0}, 4, 2, 0.7f * back);
  add_wall(emitters, low, y, z, {1, 0, 0}, 4, 2, 0.7f * back);
  add_wall(emitters, low + x, y, z, {-1, 0, 0}, 4, 2, 0.7f * back);
  return emitters;
}

std::vector<Rgb> gather(const Scene& scene, std::span<const Receiver> receivers) {
  const std::vector<Viewpoint> views = viewpoints_of(scene);
  std::vector<Rgb> light(receivers.size());
  const std::size_t blocks = (receivers.size() + RayTile::kRays - 1) / RayTile::kRays;
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const auto mine =
        receivers.subspan(block * RayTile::kRays,
                          std::min<std::size_t>(RayTile::kRays, receivers.size() - block * RayTile::kRays));
    std::vector<Vec3> places;
    // Off the surface: neither it nor a sheet of paper on it hides a place that is between two of its lumels.
    for (const Receiver& r : mine) places.push_back(r.point + 0.02 * r.normal);
    for (const Viewpoint& view : views)
      shine(view, places, [&](std::size_t i, const Vec3& direction, double strength) {
        const double facing = std::max(0.0, dot(direction, mine[i].normal));
        Rgb& sum = light[block * RayTile::kRays + i];
        sum = sum + static_cast<float>(facing * strength) * view.emitter.power;
      });
  });
  return light;
}

std::vector<std::array<Rgb, 6>> gather_all_round(const Scene& scene, std::span<const Vec3> points) {
  const std::vector<Viewpoint> views = viewpoints_of(scene);
  std::vector<std::array<Rgb, 6>> light(points.size());
  const std::size_t blocks = (points.size() + RayTile::kRays - 1) / RayTile::kRays;
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const auto mine =
        points.subspan(block * RayTile::kRays,
                       std::min<std::size_t>(RayTile::kRays, points.size() - block * RayTile::kRays));
    for (const Viewpoint& view : views)
      shine(view, mine, [&](std::size_t i, const Vec3& d, double strength) {
        const double facing[6] = {-d.x, d.x, -d.y, d.y, -d.z, d.z};
        for (std::size_t side = 0; side < 6; ++side)
          if (facing[side] > 0) {
            Rgb& sum = light[block * RayTile::kRays + i][side];
            sum = sum + static_cast<float>(facing[side] * strength) * view.emitter.power;
          }
      });
  });
  return light;
}

}  // namespace sediment::synthetic
