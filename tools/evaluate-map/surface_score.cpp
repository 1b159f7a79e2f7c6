#include "tools/evaluate-map/surface_score.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sediment::tools {

double share_within(const std::vector<Vec3>& from, const NearestPoint& to, double threshold_m) {
  std::vector<char> within(from.size(), 0);
  tbb::parallel_for(std::size_t{0}, from.size(),
                    [&](std::size_t i) { within[i] = to.has_within(from[i], threshold_m); });
  return static_cast<double>(std::count(within.begin(), within.end(), 1)) / static_cast<double>(from.size());
}

Distances summary_of(const std::vector<NearestPoint::Found>& found, double threshold_m) {
  if (found.empty()) throw std::invalid_argument("no distance: there is no point");
  const auto n = static_cast<double>(found.size());
  Distances summary;
  double sum = 0, squares = 0;
  std::size_t within = 0;
  std::vector<double> distances_m;
  for (const auto& [point_idx, distance_m, tree_idx] : found) {
    sum += distance_m;
    squares += distance_m * distance_m;
    within += distance_m <= threshold_m;
    distances_m.push_back(distance_m);
  }
  summary.mean_m = sum / n;
  summary.rmse_m = std::sqrt(squares / n);
  summary.within = static_cast<double>(within) / n;
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  summary.median_m = *middle;
  return summary;
}

SurfaceScore surface_score(const std::vector<NearestPoint::Found>& from_map,
                           const std::vector<NearestPoint::Found>& from_truth, double threshold_m) {
  SurfaceScore score;
  score.threshold_m = threshold_m;
  score.accuracy = summary_of(from_map, threshold_m);
  score.completion = summary_of(from_truth, threshold_m);
  score.chamfer_m = (score.accuracy.mean_m + score.completion.mean_m) / 2;
  const double precision = score.accuracy.within, completeness = score.completion.within;
  if (precision + completeness > 0) score.f_score = 2 * precision * completeness / (precision + completeness);
  return score;
}

}  // namespace sediment::tools
