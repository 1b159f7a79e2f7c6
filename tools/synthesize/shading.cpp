#include "tools/synthesize/shading.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>

namespace sediment::synthetic {
namespace {

std::array<float, 3> float3(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Vec3 rotate_back(const Pose& pose, Vec3 v) {
  const auto& r = pose.rotation;
  return {r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
          r[2] * v.x + r[5] * v.y + r[8] * v.z};
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

// Only what looks up is below something.
bool looks_up(const Vec3& normal) {
  return normal.z > 0.3;
}

Vec3 world_of(const View& view, const Hits& hits, int i) {
  return view.world_from_camera * (double(hits.depth_m[i]) * Vec3{hits.x[i], hits.y[i], 1});
}

/// Hits on one face of a solid, with the light that falls on them.
struct LitPlaces {
  Hits hits;
  Places places;
  Colors light;
};

/// Paints the places of a face.
void paint(const View& view, int material_idx, int face, const LitPlaces& lit, Shades& shades) {
  const Material& material = view.scene.materials[static_cast<std::size_t>(material_idx)];
  Colors paint;
  view.scene.textures[static_cast<std::size_t>(material.texture)].sample(lit.places, paint);
  for (int i = 0; i < lit.hits.count; ++i) {
    const std::size_t ray = lit.hits.ray[i];
    const Rgb painted = material.tint * Rgb{paint.r[i], paint.g[i], paint.b[i]};
    Rgb shown = painted * Rgb{lit.light.r[i], lit.light.g[i], lit.light.b[i]};
    if (material.glow > 0) shown = blend(shown, painted, material.glow);
    shades.color.r[ray] = shown.r, shades.color.g[ray] = shown.g, shades.color.b[ray] = shown.b;
    shades.face[ray] = static_cast<std::uint8_t>(face);
    shades.u_m[ray] = lit.places.u_m[i], shades.v_m[ray] = lit.places.v_m[i];
  }
}

/// Light on hits of a face: of a fixed solid from its map, else from the air around it. `normal_of(i)` is
/// that of a hit, in the world frame.
template <class NormalOf>
void light_face(const View& view, const SolidView& solid, int face, const NormalOf& normal_of,
                LitPlaces& lit) {
  Colors& light = lit.light;
  const int fixed_idx = solid.placed->fixed_idx;
  if (fixed_idx >= 0) view.lighting.on_face(fixed_idx, face, lit.places, light);
  for (int i = 0; i < lit.hits.count; ++i) {
    const Vec3 normal = normal_of(i);
    if (fixed_idx < 0) {
      const Rgb air = light_from(solid.air, normal);
      light.r[i] = air.r, light.g[i] = air.g, light.b[i] = air.b;
    }
    if (!looks_up(normal)) continue;
    const float open = open_sky(view.moment, world_of(view, lit.hits, i));
    light.r[i] *= open, light.g[i] *= open, light.b[i] *= open;
  }
}

/// Calls `work(face, hits on it)` for each face that is hit.
template <class Work>
void for_each_face(const Hits& hits, const std::array<std::int32_t, RayTile::kRays>& faces, Hits& on_face,
                   const Work& work) {
  std::bitset<kFaces> hit;
  for (int i = 0; i < hits.count; ++i) hit.set(static_cast<std::size_t>(faces[i]));
  for (int face = 0; face < kFaces; ++face) {
    if (!hit[static_cast<std::size_t>(face)]) continue;
    on_face.count = 0;
    for (int i = 0; i < hits.count; ++i)
      if (faces[i] == face) on_face.add(hits, i);
    work(face);
  }
}

void shade_box(const View& view, const SolidView& solid, const Hits& hits, Shades& shades) {
  std::array<std::int32_t, RayTile::kRays> faces;
  faces_of(solid.target, hits, faces);
  LitPlaces lit;
  for_each_face(hits, faces, lit.hits, [&](int face) {
    // Column of the rotation: where the face's axis points in the world.
    const auto& r = solid.placed->world_from_solid.rotation;
    const auto axis = static_cast<std::size_t>(face / 2);
    const double sign = face % 2 ? 1 : -1;
    places_of(solid.faces[static_cast<std::size_t>(face)], lit.hits, view.pixel_angle, lit.places);
    const Vec3 normal{sign * r[axis], sign * r[axis + 3], sign * r[axis + 6]};
    light_face(
        view, solid, face, [&](int) { return normal; }, lit);
    paint(view, solid.placed->solid->materials[static_cast<std::size_t>(face)], face, lit, shades);
  });
}

/// Every hit has a tangent plane of its own.
void place_on_round(const SurfacePoint& at, const Pose& camera_from_solid, float pixel_angle, LitPlaces& lit,
                    int i) {
  const FaceView tangent{float3(camera_from_solid.rotate(at.normal)),
                         float3(camera_from_solid.rotate(at.u_axis)),
                         float3(camera_from_solid.rotate(at.v_axis)), 0, 0};
  const Footprint f = footprint_of(tangent, lit.hits.x[i], lit.hits.y[i], lit.hits.depth_m[i], pixel_angle);
  Places& p = lit.places;
  p.u_m[i] = at.u_m, p.v_m[i] = at.v_m;
  p.du_dx[i] = f.du_dx, p.dv_dx[i] = f.dv_dx, p.du_dy[i] = f.du_dy, p.dv_dy[i] = f.dv_dy;
}

void shade_round(const View& view, const SolidView& solid, const Hits& hits, Shades& shades) {
  const Pose& frame = solid.camera_from_solid;
  std::vector<SurfacePoint> at;
  at.reserve(static_cast<std::size_t>(hits.count));
  std::array<std::int32_t, RayTile::kRays> faces;
  for (int i = 0; i < hits.count; ++i) {
    const Vec3 point = double(hits.depth_m[i]) * Vec3{hits.x[i], hits.y[i], 1};
    at.push_back(surface_at(*solid.placed->solid, rotate_back(frame, point - frame.translation)));
    faces[i] = at.back().face;
  }
  LitPlaces lit;
  std::array<std::uint8_t, RayTile::kRays> hit;  // of each place, its index in `at`
  for_each_face(hits, faces, lit.hits, [&](int face) {
    int& count = lit.places.count;
    count = 0;
    for (int i = 0; i < hits.count; ++i) {
      if (faces[i] != face) continue;
      hit[count] = static_cast<std::uint8_t>(i);
      place_on_round(at[static_cast<std::size_t>(i)], frame, view.pixel_angle, lit, count++);
    }
    const auto normal_of = [&](int i) { return solid.placed->world_from_solid.rotate(at[hit[i]].normal); };
    light_face(view, solid, face, normal_of, lit);
    paint(view, solid.placed->solid->materials[static_cast<std::size_t>(face)], face, lit, shades);
  });
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

void shade(const View& view, const RayTile& tile, int count, Shades& shades) {
  Hits hits;
  std::bitset<RayTile::kRays> done;
  for (int first = 0; first < count; ++first) {
    const std::int32_t solid_idx = tile.solid[first];
    if (solid_idx < 0 || done[static_cast<std::size_t>(first)]) continue;
    hits.count = 0;
    for (int i = first; i < count; ++i)
      if (tile.solid[i] == solid_idx) hits.add(tile, i), done.set(static_cast<std::size_t>(i));
    const SolidView& solid = view.solids[static_cast<std::size_t>(solid_idx)];
    if (solid.target.shape == Shape::box)
      shade_box(view, solid, hits, shades);
    else
      shade_round(view, solid, hits, shades);
  }
}

}  // namespace sediment::synthetic
