#pragma once

#include <cstddef>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::voxel {

struct Parameters {
  double leaf = 0.01;  ///< metres
  int min_points = 1;
};

struct Statistics {
  std::size_t points = 0;      ///< of the input
  std::size_t not_finite = 0;  ///< left out
  std::size_t voxels = 0;      ///< non-empty ones
  std::size_t too_sparse = 0;  ///< of those, the ones with fewer than min_points points
};

/// One point for each non-empty voxel, in order of z, y, x of the voxel:
/// - position: centroid of its points, summed in double;
/// - colour: mean of each channel, rounded to the nearest;
/// - label: the one most of its points have (kUnlabelled counts like any other), the smallest id if several
/// do;
/// - instance: the one most points of that label have, the smallest id if several do.
/// Throws std::runtime_error if the voxels along the three axes need more than 63 bits to number.
LabelledCloud filter(const LabelledCloud& cloud, const Parameters& parameters, Statistics& statistics);

}  // namespace sediment::voxel
