#pragma once

#include <cstddef>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::sor {

/// Which points are outliers: those far from their neighbours, or also those suspiciously near to them.
enum class Rule { one_sided, two_sided };

struct Parameters {
  int neighbors = 50;
  double sigmas = 2.5;
  Rule rule = Rule::two_sided;
};

/// Equation (10) as it came out for a cloud, and what it removed.
struct Statistics {
  std::size_t points = 0;      ///< of the input
  std::size_t not_finite = 0;  ///< left out before anything else
  std::size_t too_far = 0;     ///< mean distance above `upper_m`
  std::size_t too_near = 0;    ///< mean distance below `lower_m` (two-sided rule)
  double mean_m = 0;           ///< mu
  double deviation_m = 0;      ///< sigma; 0 where all distances are equal up to rounding
  double lower_m = 0, upper_m = 0;
};

/// Removes the points whose mean distance to their k nearest neighbours lies outside
/// (mu - sigmas * sigma, mu + sigmas * sigma), and points with a coordinate that is not finite or beyond 1e18
/// m. The others stay as they are and in their order. mu and sigma are summed one point after the other as
/// PCL does, so the one-sided rule keeps exactly the points that pcl::StatisticalOutlierRemoval keeps.
Statistics remove_outliers(LabelledCloud& cloud, const Parameters& parameters);

}  // namespace sediment::sor
