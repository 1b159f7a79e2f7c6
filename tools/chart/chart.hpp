#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace sediment::tools {

/// A line through points. A point that is not finite interrupts it.
struct Series {
  std::string name;  ///< for the legend; none if empty
  std::vector<cv::Point2d> points;
  std::array<std::uint8_t, 3> rgb{};
  bool dots = false;  ///< only the points, without lines between them
};

/// One diagram with its axes.
struct Panel {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  bool equal_scale = false;  ///< one metre is as long in x as in y: for maps
  bool from_zero = false;    ///< the y axis begins at 0
};

/// Draws the panels from left to right, each of the given size, as CV_8UC3 BGR. Texts are ASCII.
cv::Mat draw(const std::vector<Panel>& panels, cv::Size panel_size = {720, 480});

/// A step of 1, 2 or 5 times a power of ten that divides a range into about `count` parts.
double axis_step(double range, int count);

}  // namespace sediment::tools
