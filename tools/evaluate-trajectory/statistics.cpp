#include "tools/evaluate-trajectory/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sediment::tools {

Statistics statistics_of(const std::vector<double>& values) {
  if (values.empty()) throw std::invalid_argument("statistics of no value");
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<double>(sorted.size());
  Statistics result;
  double sum = 0;
  for (const double value : values) {
    sum += value;
    result.sse += value * value;
  }
  result.mean = sum / n;
  result.rmse = std::sqrt(result.sse / n);
  double spread = 0;
  for (const double value : values) spread += (value - result.mean) * (value - result.mean);
  result.std = std::sqrt(spread / n);
  const std::size_t middle = sorted.size() / 2;
  result.median = sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
  result.min = sorted.front();
  result.max = sorted.back();
  return result;
}

}  // namespace sediment::tools
