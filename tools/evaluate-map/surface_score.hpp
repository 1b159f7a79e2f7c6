#pragma once

#include <vector>

#include "tools/evaluate-map/nearest_point.hpp"

namespace sediment::tools {

/// Distances to the nearest point of the other side, metres.
struct Distances {
  double mean_m = 0, median_m = 0, rmse_m = 0;
  double within = 0;  ///< share at most as far as the threshold
};

/// Agreement of a map with the true surfaces.
struct SurfaceScore {
  double threshold_m = 0.05;
  Distances accuracy;    ///< from the points of the map to the truth; `within` is the precision
  Distances completion;  ///< from the true points that never move to the map; `within` is the completeness
  double chamfer_m = 0;  ///< mean of both mean distances
  double f_score = 0;    ///< harmonic mean of precision and completeness
};

/// Share of the points that have one of the other side within the threshold.
double share_within(const std::vector<Vec3>& from, const NearestPoint& to, double threshold_m);
/// Throws std::invalid_argument if there is nothing.
Distances summary_of(const std::vector<NearestPoint::Found>& found, double threshold_m);

/// `from_map` are the nearest true points of those of the map, `from_truth` the nearest ones of the map of
/// the true points that never move.
SurfaceScore surface_score(const std::vector<NearestPoint::Found>& from_map,
                           const std::vector<NearestPoint::Found>& from_truth, double threshold_m);

}  // namespace sediment::tools
