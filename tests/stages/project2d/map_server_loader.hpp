#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sediment::test {

/// What ROS holds after loading a map: nav_msgs/OccupancyGrid. Row 0 is the lowest y; 100 occupied, 0 free,
/// -1 unknown.
struct OccupancyGrid {
  int width = 0, height = 0;
  double resolution_m = 0, origin_x_m = 0, origin_y_m = 0;
  std::vector<int> values;

  int at(int x, int y) const { return values[static_cast<std::size_t>(y * width + x)]; }
};

/// Thresholds to use in place of those in map.yaml, as a loader with defaults of its own would.
struct Thresholds {
  double occupied, free;
};

/// Written from the documentation of map_server (ROS 1) and nav2_map_server, without our own reader: strict
/// about keys, the PGM header and the number of bytes. Modes trinary and raw. Throws std::runtime_error.
OccupancyGrid load_as_map_server(const std::filesystem::path& yaml, const Thresholds* instead = nullptr);

}  // namespace sediment::test
