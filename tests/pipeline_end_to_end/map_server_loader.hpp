#pragma once

#include <filesystem>

namespace sediment::test {

/// What ROS 1's map_server and nav2's make of the cells of a map.
struct LoadedMap {
  int width = 0, height = 0;
  long occupied = 0, free = 0, unknown = 0;
};

/// Loads a map as ROS 1's map_server does (image_loader.cpp, mode trinary), and is as strict as the strictest
/// of the loaders: `negate` is a number, `origin` has three finite ones, `image` is relative to the YAML
/// file, the picture is a binary PGM of the size its header says. Throws std::runtime_error that names the
/// file.
LoadedMap load_map(const std::filesystem::path& yaml);

}  // namespace sediment::test
