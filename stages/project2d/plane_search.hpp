#pragma once

#include <span>
#include <vector>

#include "stages/project2d/surface.hpp"

namespace sediment::project2d {

/// A plane in a surface and the patches on it.
struct SurfacePlane {
  Plane plane;
  std::vector<std::size_t> patches;  ///< indices, ascending
  std::size_t samples = 0;           ///< of its patches, within the tolerance
  double rms_m = 0;                  ///< of those samples
};

/// The planes of a surface whose normal is within `cone_deg` of `axis` (either way round), largest first,
/// until they are smaller than `min_area_m2`. A consensus search as in RANSAC, but over all patches as
/// hypotheses (every n-th if they are very many) in place of random triples: a patch supports a plane if its
/// centre lies within `tolerance_m` and its normal agrees, so walls do not support the floor that they cut.
/// Refined by least squares with a tolerance that shrinks to the noise.
std::vector<SurfacePlane> find_planes(const Surface& surface, Vec3 axis, double cone_deg, double tolerance_m,
                                      double min_area_m2);

/// A plane that was fitted to a layer of points, and what lies in the layer.
struct Layer {
  Plane plane;
  Vec3 center;         ///< of the columns the plane was fitted to
  double area_m2 = 0;  ///< of the columns with a point in the layer
  double rms_m = 0;    ///< of their heights
};

/// Fits the plane to all points within `tolerance_m`: one height, the mean of its points, for each column of
/// 5 cm across the plane, so that neither the thickness of a noisy layer nor how often a place was seen pulls
/// at it; then least squares with a tolerance that shrinks to the noise of the columns. Repeated until it
/// rests.
Layer fit_layer(std::span<const Vec3> points, Plane plane, double tolerance_m);

}  // namespace sediment::project2d
