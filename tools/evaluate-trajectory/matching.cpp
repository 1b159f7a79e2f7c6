#include "tools/evaluate-trajectory/matching.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/artifacts/sequence.hpp"

namespace sediment::tools {
namespace {

/// The first of the nearest, as numpy.argmin finds it.
std::size_t first_nearest(const std::vector<double>& ascending, double value) {
  std::size_t at = static_cast<std::size_t>(std::lower_bound(ascending.begin(), ascending.end(), value) -
                                            ascending.begin());
  if (at == ascending.size()) return at - 1;
  if (at > 0 && std::abs(ascending[at - 1] - value) <= std::abs(ascending[at] - value)) --at;
  return at;
}

}  // namespace

std::vector<double> stamps_of(const Trajectory& trajectory) {
  std::vector<double> stamps_s;
  for (const StampedPose& pose : trajectory) stamps_s.push_back(pose.stamp_s);
  return stamps_s;
}

std::vector<Match> match_as_tum(const Trajectory& truth, const Trajectory& estimate, double tolerance_s) {
  std::vector<Match> matches;
  for (const auto& [truth_idx, estimate_idx] : associate(stamps_of(truth), stamps_of(estimate), tolerance_s))
    matches.push_back({truth_idx, estimate_idx});
  return matches;
}

std::vector<Match> match_as_evo(const Trajectory& truth, const Trajectory& estimate, double tolerance_s) {
  const bool truth_is_shorter = estimate.size() > truth.size();
  const auto from = stamps_of(truth_is_shorter ? truth : estimate);
  const auto to = stamps_of(truth_is_shorter ? estimate : truth);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < from.size() && !to.empty(); ++i) {
    const std::size_t j = first_nearest(to, from[i]);
    if (std::abs(to[j] - from[i]) <= tolerance_s)
      matches.push_back(truth_is_shorter ? Match{i, j} : Match{j, i});
  }
  return matches;
}

std::size_t closest_index(const std::vector<double>& ascending, double value) {
  std::size_t begin = 0, end = ascending.size(), best = 0;
  double difference = std::abs(ascending[0] - value);
  while (begin < end) {
    const std::size_t middle = (begin + end) / 2;
    if (std::abs(ascending[middle] - value) < difference) {
      difference = std::abs(ascending[middle] - value);
      best = middle;
    }
    if (ascending[middle] == value) return middle;
    if (ascending[middle] > value)
      end = middle;
    else
      begin = middle + 1;
  }
  return best;
}

}  // namespace sediment::tools
