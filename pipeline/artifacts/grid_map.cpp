#include "pipeline/artifacts/grid_map.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/yaml_fields.hpp"

namespace sediment {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kOccupiedThreshold = 0.65;
/// Below the (255 - 205) / 255 = 0.196 of an unknown cell: with nav2's default of 0.25 it would load as free.
constexpr double kFreeThreshold = 0.19;

std::string yaml_of(const GridMap& map, const char* image, const char* mode) {
  char text[512];
  std::snprintf(text, sizeof text,
                "image: %s\nmode: %s\nresolution: %.9g\norigin: [%.9g, %.9g, 0]\nnegate: 0\n"
                "occupied_thresh: %.2f\nfree_thresh: %.2f\n",
                image, mode, map.resolution_m, map.origin_x_m, map.origin_y_m, kOccupiedThreshold,
                kFreeThreshold);
  return text;
}

/// A binary PGM of one pixel a cell, highest y first.
template <class PixelOf>
void write_image(const std::filesystem::path& file, const GridMap& map, const PixelOf& pixel_of) {
  if (map.width <= 0 || map.height <= 0 ||
      map.cells.size() != static_cast<std::size_t>(map.width) * map.height)
    throw std::runtime_error("cannot write " + file.string() + ": " + std::to_string(map.width) + " x " +
                             std::to_string(map.height) + " cells expected, " +
                             std::to_string(map.cells.size()) + " found");
  std::string image = "P5\n" + std::to_string(map.width) + " " + std::to_string(map.height) + "\n255\n";
  for (int y = map.height - 1; y >= 0; --y)
    for (int x = 0; x < map.width; ++x)
      image.push_back(pixel_of(static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                               static_cast<std::size_t>(x)));
  write_bytes(file, {image});
}

std::string ground_of(const GridMap& map) {
  const auto& r = map.map_from_world.rotation;
  const Vec3 t = map.map_from_world.translation;
  OrderedJson json;
  json["source"] = map.ground_source;
  json["map_from_world"] = {
      {r[0], r[1], r[2], t.x}, {r[3], r[4], r[5], t.y}, {r[6], r[7], r[8], t.z}, {0, 0, 0, 1}};
  // Points of the ground: normal . point + offset = 0 in the world frame.
  json["plane"] = {{"normal", {r[6], r[7], r[8]}}, {"offset_m", t.z}};
  return json.dump(1) + "\n";
}

void read_ground(const std::filesystem::path& file, GridMap& map) {
  try {
    const OrderedJson json = OrderedJson::parse(read_bytes(file));
    map.ground_source = json.at("source").get<std::string>();
    const auto rows = json.at("map_from_world").get<std::array<std::array<double, 4>, 4>>();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        map.map_from_world.rotation[row * 3 + column] = rows[row][column];
    map.map_from_world.translation = {rows[0][3], rows[1][3], rows[2][3]};
  } catch (const OrderedJson::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

struct Thresholds {
  bool negate;
  double occupied, free;

  /// Source: map_server's image_loader.cpp, mode "trinary".
  Cell cell_of(std::uint8_t grey) const {
    const double occupancy = negate ? grey / 255.0 : (255 - grey) / 255.0;
    if (occupancy > occupied) return Cell::occupied;
    return occupancy < free ? Cell::free : Cell::unknown;
  }
};

void read_cells(const std::filesystem::path& image_file, const Thresholds& thresholds, GridMap& map) {
  const std::string bytes = read_bytes(image_file);
  cv::Mat image;
  if (!bytes.empty())
    image = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data())),
                         cv::IMREAD_GRAYSCALE);
  if (image.empty())
    throw std::runtime_error(image_file.string() + ": cannot be decoded: truncated or no image");
  map.width = image.cols;
  map.height = image.rows;
  map.cells.resize(image.total());
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      map.at(x, y) = thresholds.cell_of(image.at<std::uint8_t>(map.height - 1 - y, x));
}

}  // namespace

void write_grid_map(const std::filesystem::path& folder, const GridMap& map) {
  write_image(folder / "map.pgm", map, [&](std::size_t cell) { return static_cast<char>(map.cells[cell]); });
  write_bytes(folder / "map.yaml", {yaml_of(map, "map.pgm", "trinary")});
  write_bytes(folder / "ground.json", {ground_of(map)});
}

void write_cost_mask(const std::filesystem::path& folder, const GridMap& map,
                     const std::vector<std::uint8_t>& costs) {
  if (costs.size() != map.cells.size())
    throw std::runtime_error("cannot write " + (folder / "costs.pgm").string() + ": " +
                             std::to_string(map.cells.size()) + " costs expected, " +
                             std::to_string(costs.size()) + " found");
  write_image(folder / "costs.pgm", map, [&](std::size_t cell) { return static_cast<char>(costs[cell]); });
  write_bytes(folder / "costs.yaml", {yaml_of(map, "costs.pgm", "raw")});
}

GridMap read_grid_map(const std::filesystem::path& folder) {
  const std::filesystem::path yaml = folder / "map.yaml";
  const YamlFields fields(
      yaml.string(), parse_yaml(read_bytes(yaml), yaml.string()),
      {"image", "mode", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"});
  if (const auto mode = fields.get<std::string>("mode", "trinary"); mode != "trinary")
    fields.fail(fields.node("mode"), "only the mode trinary is known, found \"" + mode + "\"");
  GridMap map;
  map.resolution_m = fields.require<double>("resolution");
  if (!(map.resolution_m > 0)) fields.fail(fields.node("resolution"), "the resolution must be above 0");
  const auto origin = fields.require<std::vector<double>>("origin");
  if (origin.size() != 3 || origin[2] != 0)
    fields.fail(fields.node("origin"), "expected an origin [x, y, 0]");
  map.origin_x_m = origin[0];
  map.origin_y_m = origin[1];
  const Thresholds thresholds{fields.require<int>("negate") != 0, fields.require<double>("occupied_thresh"),
                              fields.require<double>("free_thresh")};
  read_cells(folder / fields.require<std::string>("image"), thresholds, map);
  if (std::filesystem::exists(folder / "ground.json")) read_ground(folder / "ground.json", map);
  return map;
}

}  // namespace sediment
