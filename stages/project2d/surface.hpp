#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stages/project2d/plane.hpp"

namespace sediment::project2d {

/// A flat piece of surface: consecutive samples.
struct Patch {
  std::size_t begin = 0, end = 0;  ///< of Surface::samples
  Vec3 center, normal;             ///< the sign of the normal means nothing

  std::size_t size() const { return end - begin; }
};

/// A cloud thinned out to one sample per cube of 5 cm, so that counting samples measures area and not how
/// often something was seen, and the cubes of 25 cm (more in sparse clouds) in which the samples lie on a
/// plane.
struct Surface {
  std::vector<Vec3> samples;  ///< centroids, sorted so that those of one patch follow each other
  std::vector<Patch> patches;

  static double area_m2(std::size_t samples);
};

/// Points must be finite. Cubes are aligned with the axes: a plane across an axis is sampled best. A patch is
/// flat if its samples are within about `tolerance_m` of their plane.
Surface sample_surface(std::span<const Vec3> points, double tolerance_m);

}  // namespace sediment::project2d
