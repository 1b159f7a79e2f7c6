#pragma once

#include <span>
#include <vector>

#include "tools/synthesize/scene.hpp"

namespace sediment::synthetic {

/// A point that sends light into the half space of its normal, by the cosine.
struct Emitter {
  Vec3 position, normal;
  Rgb power;
  double least_distance2;  ///< m^2: keeps the neighbourhood of a point from glowing
};

/// Points on the lamps, and points on walls, floor and ceiling that throw light back.
std::vector<Emitter> emitters_of(const Scene& scene);

/// A place that receives light.
struct Receiver {
  Vec3 point, normal;
};

/// Light that arrives at each place, shadows included. `normal_free` counts every direction of arrival fully
/// per axis instead (six values a place: -x +x -y +y -z +z).
std::vector<Rgb> gather(const Scene& scene, std::span<const Receiver> receivers);
std::vector<std::array<Rgb, 6>> gather_all_round(const Scene& scene, std::span<const Vec3> points);

}  // namespace sediment::synthetic
