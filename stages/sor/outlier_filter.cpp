#include "stages/sor/outlier_filter.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "stages/sor/neighbor_distances.hpp"

namespace sediment::sor {
namespace {

/// Squares of distances beyond this do not fit a float.
constexpr float kFarthest_m = 1e18f;

bool is_usable(const LabelledPoint& p) {
  return std::abs(p.x) <= kFarthest_m && std::abs(p.y) <= kFarthest_m && std::abs(p.z) <= kFarthest_m;
}

std::vector<Position> positions_of(const LabelledCloud& cloud) {
  std::vector<Position> positions(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) positions[i] = {cloud[i].x, cloud[i].y, cloud[i].z};
  return positions;
}

/// mu, sigma and the limits of equation (10). The square is a product of floats and the variance is formed
/// from the sums, with the same rounding as in PCL. Without spread (one point, or a variance that rounding
/// made negative) there is nothing to compare with, and the limits exclude nothing.
void measure(std::span<const float> means_m, double sigmas, Statistics& statistics) {
  double sum = 0, squared_sum = 0;
  for (const float mean : means_m) {
    sum += mean;
    squared_sum += mean * mean;
  }
  const auto count = static_cast<double>(means_m.size());
  const double variance = (squared_sum - sum * sum / count) / (count - 1);
  statistics.mean_m = means_m.empty() ? 0 : sum / count;
  statistics.lower_m = 0;
  statistics.upper_m = std::numeric_limits<double>::max();
  if (!(variance >= 0) || !std::isfinite(variance)) return;
  statistics.deviation_m = std::sqrt(variance);
  statistics.lower_m = statistics.mean_m - sigmas * statistics.deviation_m;
  statistics.upper_m = statistics.mean_m + sigmas * statistics.deviation_m;
}

}  // namespace

Statistics remove_outliers(LabelledCloud& cloud, const Parameters& parameters) {
  Statistics statistics;
  statistics.points = cloud.size();
  std::erase_if(cloud, [](const LabelledPoint& point) { return !is_usable(point); });
  statistics.not_finite = statistics.points - cloud.size();

  const std::vector<float> means_m =
      mean_neighbor_distances(positions_of(cloud), static_cast<std::size_t>(parameters.neighbors));
  measure(means_m, parameters.sigmas, statistics);

  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool far = means_m[i] > statistics.upper_m;
    const bool near = parameters.rule == Rule::two_sided && means_m[i] < statistics.lower_m;
    statistics.too_far += far ? 1 : 0;
    statistics.too_near += near ? 1 : 0;
    if (!far && !near) cloud[kept++] = cloud[i];
  }
  cloud.resize(kept);
  return statistics;
}

}  // namespace sediment::sor
