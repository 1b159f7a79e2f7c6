#pragma once

#include <array>
#include <string>
#include <vector>

namespace sediment::tabulate {

struct Bar {
  std::string name;  ///< for the legend; equal names have equal colours
  double value = 0;
  std::string text;  ///< above the bar
};

/// Bars that stand together.
struct BarGroup {
  std::string name;
  std::vector<Bar> bars;
};

/// A bar chart as SVG with a linear axis from 0. Equal input gives equal bytes.
std::string bar_chart(const std::vector<BarGroup>& groups, const std::string& title, const std::string& axis);

}  // namespace sediment::tabulate
