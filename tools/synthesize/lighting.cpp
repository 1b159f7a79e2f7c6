#include "tools/synthesize/lighting.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synthesize/emitters.hpp"

namespace sediment::synthetic {

Lighting::Lighting(const Scene& scene, double lumel_m) {
  light_faces(scene, lumel_m);
  light_air(scene);
}

void Lighting::light_faces(const Scene& scene, double lumel_m) {
  std::vector<Receiver> receivers;
  for (const Body& body : scene.bodies) {
    if (body.mobility != Mobility::fixed) continue;
    for (const Solid& solid : body.solids) {
      first_map_.push_back(static_cast<int>(maps_.size()));
      for (int face = 0; face < face_count(solid.shape); ++face) {
        const FaceRange range = face_range(solid, face);
        Map map;
        map.columns = std::max(1, static_cast<int>(std::lround(range.u_m / lumel_m)));
        map.rows = std::max(1, static_cast<int>(std::lround((range.v_high_m - range.v_low_m) / lumel_m)));
        map.cells_per_m_u = static_cast<float>(map.columns / range.u_m);
        map.cells_per_m_v = static_cast<float>(map.rows / (range.v_high_m - range.v_low_m));
        map.shift_v_m = static_cast<float>(-range.v_low_m);
        for (int row = 0; row < map.rows; ++row)
          for (int column = 0; column < map.columns; ++column) {
            const Vec3 point = point_on(solid, face, (column + 0.5) / map.cells_per_m_u,
                                        (row + 0.5) / map.cells_per_m_v + range.v_low_m);
            receivers.push_back({solid.body_from_solid * point,
                                 solid.body_from_solid.rotate(surface_at(solid, point).normal)});
          }
        maps_.push_back(std::move(map));
      }
    }
  }
  const std::vector<Rgb> light = gather(scene, receivers);
  auto next = light.begin();
  for (Map& map : maps_) {
    const auto end = next + map.columns * map.rows;
    map.light.assign(next, end);
    next = end;
  }
}

void Lighting::light_air(const Scene& scene) {
  low_ = scene.room_low;
  const Vec3 size = scene.room_high - scene.room_low;
  probes_across_ = {static_cast<int>(size.x / probe_spacing_m_) + 1,
                    static_cast<int>(size.y / probe_spacing_m_) + 1,
                    static_cast<int>(size.z / probe_spacing_m_) + 1};
  std::vector<Vec3> points;
  for (int k = 0; k < probes_across_[2]; ++k)
    for (int j = 0; j < probes_across_[1]; ++j)
      for (int i = 0; i < probes_across_[0]; ++i)
        points.push_back(low_ + probe_spacing_m_ * Vec3{i + 0.5, j + 0.5, k + 0.5});
  probes_ = gather_all_round(scene, points);
}

inline Rgb Lighting::Map::at(float u_m, float v_m) const {
  const float u = std::clamp(u_m * cells_per_m_u - 0.5f, 0.f, static_cast<float>(columns - 1));
  const float v = std::clamp((v_m + shift_v_m) * cells_per_m_v - 0.5f, 0.f, static_cast<float>(rows - 1));
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  const int right = std::min(left + 1, columns - 1), bottom = std::min(top + 1, rows - 1);
  const float fu = u - static_cast<float>(left), fv = v - static_cast<float>(top);
  const auto cell = [&](int row, int column) {
    return light[static_cast<std::size_t>(row) * columns + column];
  };
  return (1 - fv) * ((1 - fu) * cell(top, left) + fu * cell(top, right)) +
         fv * ((1 - fu) * cell(bottom, left) + fu * cell(bottom, right));
}

Rgb Lighting::on_face(int fixed_idx, int face, float u_m, float v_m) const {
  return map_of(fixed_idx, face).at(u_m, v_m);
}

void Lighting::on_face(int fixed_idx, int face, const Places& places, Colors& light) const {
  const Map& map = map_of(fixed_idx, face);
  for (int i = 0; i < places.count; ++i) {
    const Rgb here = map.at(places.u_m[i], places.v_m[i]);
    light.r[i] = here.r, light.g[i] = here.g, light.b[i] = here.b;
  }
}

LightCube Lighting::in_air(Vec3 point) const {
  const Vec3 p = (point - low_) / probe_spacing_m_ - Vec3{0.5, 0.5, 0.5};
  const double coordinate[3] = {p.x, p.y, p.z};
  int cell[3];
  float fraction[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double bounded =
        std::clamp(coordinate[axis], 0.0, probes_across_[static_cast<std::size_t>(axis)] - 1.001);
    cell[axis] = static_cast<int>(bounded);
    fraction[axis] = static_cast<float>(bounded - cell[axis]);
  }
  LightCube sum{};
  for (int corner = 0; corner < 8; ++corner) {
    float weight = 1;
    int index[3];
    for (int axis = 0; axis < 3; ++axis) {
      const bool high = corner >> axis & 1;
      index[axis] = cell[axis] + high;
      weight *= high ? fraction[axis] : 1 - fraction[axis];
    }
    const auto row = static_cast<std::size_t>(index[2]) * static_cast<std::size_t>(probes_across_[1]) +
                     static_cast<std::size_t>(index[1]);
    const LightCube& probe =
        probes_[row * static_cast<std::size_t>(probes_across_[0]) + static_cast<std::size_t>(index[0])];
    for (std::size_t side = 0; side < 6; ++side) sum[side] = sum[side] + weight * probe[side];
  }
  return sum;
}

Rgb light_from(const LightCube& cube, Vec3 normal) {
  const double n[3] = {normal.x, normal.y, normal.z};
  Rgb sum;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum = sum + static_cast<float>(n[axis] * n[axis]) * cube[2 * axis + (n[axis] > 0)];
  return sum;
}

}  // namespace sediment::synthetic
