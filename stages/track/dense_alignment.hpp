#pragma once

#include "pipeline/scene/pose.hpp"
#include "stages/track/dense_frame.hpp"

namespace sediment::track {

using DenseImages = std::array<DenseImage, kDenseLevels>;

/// How one frame lies against another.
struct DenseAlignment {
  Pose current_from_reference;
  /// Information of the error (rotation vector on the left, then translation), 6 x 6, row-major: how well
  /// each direction is known. Neighbouring pixels err alike: it counts them as few.
  std::array<double, 36> information{};
  double overlap =
      0;  ///< share of the reference's points that are seen by the current frame at the depth expected
  double residual_m = 0;  ///< robust standard deviation of the distances between the surfaces
};

/// Largest standard deviation over all directions of rotation [rad] and translation [m]; infinite if one is
/// not known at all.
double worst_deviation(const DenseAlignment& alignment);

/// Aligns two frames as wholes: distances between surfaces (point to plane; Chen and Medioni 1992) and
/// differences of brightness (Steinbrucker, Sturm, Cremers 2011) of all pixels together, each scaled by its
/// own noise, with robust weights and a gain between the two exposures; from the coarsest level to
/// `finest_level`. `start` is current_from_reference. Directions that nothing tells stay where the start has
/// them.
DenseAlignment align(const DenseImages& reference, const DenseImages& current, const DenseCamera& camera,
                     const Pose& start, int finest_level, double depth_noise);

}  // namespace sediment::track
