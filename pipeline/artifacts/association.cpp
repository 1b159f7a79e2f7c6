#include <algorithm>
#include <tuple>

#include "pipeline/artifacts/sequence.hpp"

namespace sediment {

std::vector<std::pair<std::size_t, std::size_t>> associate(const std::vector<double>& first_s,
                                                           const std::vector<double>& second_s,
                                                           double tolerance_s) {
  // All candidates; of equal differences the earlier stamps go first, as in the sorted list of associate.py.
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  std::size_t from = 0;
  for (std::size_t i = 0; i < first_s.size(); ++i) {
    while (from < second_s.size() && first_s[i] - second_s[from] >= tolerance_s) ++from;
    for (std::size_t j = from; j < second_s.size(); ++j) {
      const double difference_s = std::abs(first_s[i] - second_s[j]);
      if (difference_s < tolerance_s)
        candidates.emplace_back(difference_s, i, j);
      else if (second_s[j] > first_s[i])
        break;
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> first_used(first_s.size(), false), second_used(second_s.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [difference_s, i, j] : candidates) {
    if (first_used[i] || second_used[j]) continue;
    first_used[i] = second_used[j] = true;
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace sediment
