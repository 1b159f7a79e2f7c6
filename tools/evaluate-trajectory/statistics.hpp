#pragma once

#include <vector>

namespace sediment::tools {

/// Statistics of errors as TUM's tools and evo define them.
struct Statistics {
  double rmse = 0, mean = 0, median = 0;
  double std = 0;  ///< about the mean, divided by n (numpy's default)
  double min = 0, max = 0;
  double sse = 0;  ///< sum of the squares
};

/// Throws std::invalid_argument if there is no value.
Statistics statistics_of(const std::vector<double>& values);

}  // namespace sediment::tools
