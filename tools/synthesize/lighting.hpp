#pragma once

#include <vector>

#include "tools/synthesize/scene.hpp"

namespace sediment::synthetic {

/// Light on surfaces that look to -x +x -y +y -z +z.
using LightCube = std::array<Rgb, 6>;
/// Light on a surface with this unit normal: by the squares of its components (Valve's ambient cube).
Rgb light_from(const LightCube& cube, Vec3 normal);

/// Light in the room, found once: for all that never moves a map of soft shadows on each face, for all that
/// moves a grid of probes in the air. Both gather the lamps and what the walls, floor and ceiling throw back
/// (some dozens of small emitters there: Keller, Instant Radiosity, 1997), hidden by what stands between.
class Lighting {
 public:
  /// `lumel_m` is the side of a cell of the maps.
  Lighting(const Scene& scene, double lumel_m);

  /// Factor on the colour of a place on a fixed solid (index as PlacedSolid::fixed_idx).
  Rgb on_face(int fixed_idx, int face, float u_m, float v_m) const;
  void on_face(int fixed_idx, int face, const Places& places, Colors& light) const;
  /// The same anywhere in the room.
  LightCube in_air(Vec3 point) const;

 private:
  struct Map {
    int columns = 1, rows = 1;
    float cells_per_m_u = 0, cells_per_m_v = 0, shift_v_m = 0;
    std::vector<Rgb> light;

    Rgb at(float u_m, float v_m) const;
  };
  const Map& map_of(int fixed_idx, int face) const {
    return maps_[static_cast<std::size_t>(first_map_[static_cast<std::size_t>(fixed_idx)] + face)];
  }

  void light_faces(const Scene& scene, double lumel_m);
  void light_air(const Scene& scene);

  std::vector<Map> maps_;
  std::vector<int> first_map_;  ///< by fixed_idx
  Vec3 low_;
  double probe_spacing_m_ = 0.5;
  std::array<int, 3> probes_across_{};
  std::vector<LightCube> probes_;
};

}  // namespace sediment::synthetic
