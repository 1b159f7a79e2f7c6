#include "tests/stages/project2d/map_server_loader.hpp"

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace sediment::test {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot open " + file.string());
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::map<std::string, std::string> keys_of(const std::string& yaml) {
  std::map<std::string, std::string> keys;
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) throw std::runtime_error("not key: value: " + line);
    if (!keys.emplace(line.substr(0, colon), line.substr(colon + 2)).second)
      throw std::runtime_error("twice: " + line);
  }
  return keys;
}

}  // namespace

OccupancyGrid load_as_map_server(const std::filesystem::path& yaml, const Thresholds* instead) {
  const auto keys = keys_of(content_of(yaml));
  OccupancyGrid grid;
  double yaw = 1;
  if (std::sscanf(keys.at("origin").c_str(), "[%lf, %lf, %lf]", &grid.origin_x_m, &grid.origin_y_m, &yaw) !=
          3 ||
      yaw != 0)
    throw std::runtime_error("origin: " + keys.at("origin"));
  grid.resolution_m = std::stod(keys.at("resolution"));
  const bool raw = keys.at("mode") == "raw";
  if (keys.at("negate") != "0" || (!raw && keys.at("mode") != "trinary"))
    throw std::runtime_error("negate or mode");
  const Thresholds thresholds = instead != nullptr ? *instead
                                                   : Thresholds{std::stod(keys.at("occupied_thresh")),
                                                                std::stod(keys.at("free_thresh"))};

  const std::string pgm = content_of(yaml.parent_path() / keys.at("image"));
  int grey_levels = 0, header = 0;
  if (std::sscanf(pgm.c_str(), "P5 %d %d %d%n", &grid.width, &grid.height, &grey_levels, &header) != 3 ||
      grey_levels != 255)
    throw std::runtime_error("not a binary 8-bit PGM");
  const auto pixels = static_cast<std::size_t>(header) + 1;  // one white space ends the header
  const auto count = static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height);
  if (pgm.size() != pixels + count) throw std::runtime_error("wrong number of bytes");
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const auto row = static_cast<std::size_t>(grid.height - 1 - y);  // image row 0 is the top
      const auto grey = static_cast<unsigned char>(
          pgm[pixels + row * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x)]);
      if (raw) {  // nav2: the grey value itself, what is above 100 is unknown
        grid.values.push_back(grey <= 100 ? grey : -1);
        continue;
      }
      const double occupancy = (255 - grey) / 255.0;
      grid.values.push_back(occupancy > thresholds.occupied ? 100 : occupancy < thresholds.free ? 0 : -1);
    }
  return grid;
}

}  // namespace sediment::test
