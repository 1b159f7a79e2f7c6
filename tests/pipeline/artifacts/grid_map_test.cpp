#include "pipeline/artifacts/grid_map.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "pipeline/artifacts/file_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

GridMap some_map() {
  GridMap map;
  map.width = 3;
  map.height = 2;
  map.resolution_m = 0.05;
  map.origin_x_m = -1.25;
  map.origin_y_m = 2;
  map.cells = {Cell::free, Cell::occupied, Cell::unknown, Cell::unknown, Cell::unknown, Cell::free};
  map.map_from_world = rotation_from({1.2, 0.1, 0});
  map.map_from_world.translation = {0, 0, 0.75};
  map.ground_source = "ransac";
  return map;
}

/// A map as ROS loads it: occupancy 100, 0 or -1 by cell, first row at the lowest y. Written from nav2's and
/// map_server's documentation, without our reader.
struct LoadedMap {
  std::map<std::string, std::string> keys;
  int width = 0, height = 0;
  std::vector<int> occupancy;
};

LoadedMap load_as_map_server(const std::filesystem::path& folder, double free_threshold_override = -1) {
  LoadedMap map;
  std::istringstream yaml(read_bytes(folder / "map.yaml"));
  for (std::string line; std::getline(yaml, line);)
    map.keys[line.substr(0, line.find(": "))] = line.substr(line.find(": ") + 2);
  const std::string image = read_bytes(folder / map.keys.at("image"));
  std::istringstream pgm(image);
  std::string magic;
  int max = 0;
  pgm >> magic >> map.width >> map.height >> max;
  REQUIRE(magic == "P5");
  REQUIRE(max == 255);
  const auto pixels = static_cast<std::size_t>(pgm.tellg()) + 1;
  REQUIRE(image.size() == pixels + static_cast<std::size_t>(map.width * map.height));
  const double occupied = std::stod(map.keys.at("occupied_thresh"));
  const double free =
      free_threshold_override < 0 ? std::stod(map.keys.at("free_thresh")) : free_threshold_override;
  for (int y = map.height - 1; y >= 0; --y)
    for (int x = 0; x < map.width; ++x) {
      const auto grey =
          static_cast<unsigned char>(image[pixels + static_cast<std::size_t>(y * map.width + x)]);
      const double p = (255 - grey) / 255.0;
      map.occupancy.push_back(p > occupied ? 100 : p < free ? 0 : -1);
    }
  return map;
}

}  // namespace

TEST_CASE("a map loads in map_server and nav2 as it was meant, unknown cells included") {
  const test::TemporaryFolder folder;
  write_grid_map(folder.path(), some_map());
  const LoadedMap map = load_as_map_server(folder.path());
  CHECK(map.width == 3);
  CHECK(map.height == 2);
  CHECK(map.occupancy == std::vector<int>{0, 100, -1, -1, -1, 0});
  CHECK(map.keys.at("resolution") == "0.05");
  CHECK(map.keys.at("origin") == "[-1.25, 2, 0]");
  CHECK(map.keys.at("negate") == "0");
  // What the threshold is for: nav2's default would turn unknown into free.
  CHECK(load_as_map_server(folder.path(), 0.25).occupancy == std::vector<int>{0, 100, 0, 0, 0, 0});
}

TEST_CASE("a map survives writing and reading, its ground plane included") {
  const test::TemporaryFolder folder;
  const GridMap map = some_map();
  write_grid_map(folder.path(), map);
  const GridMap read = read_grid_map(folder.path());
  CHECK(read.cells == map.cells);
  CHECK(read.width == 3);
  CHECK(read.origin_x_m == map.origin_x_m);
  CHECK(read.origin_y_m == map.origin_y_m);
  CHECK(read.resolution_m == map.resolution_m);
  CHECK(read.map_from_world == map.map_from_world);
  CHECK(read.ground_source == "ransac");
}

TEST_CASE("maps of other programs are read with their own thresholds and colours") {
  const test::TemporaryFolder folder;
  write_bytes(folder / "map.yaml", {"image: other.pgm\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\nnegate: 1\n"
                                    "occupied_thresh: 0.5\nfree_thresh: 0.2\n"});
  write_bytes(folder / "other.pgm", {"P5\n# a comment\n2 1\n255\n", std::string_view("\x00\xff", 2)});
  const GridMap map = read_grid_map(folder.path());
  CHECK(map.cells == std::vector<Cell>{Cell::free, Cell::occupied});
}

TEST_CASE("a damaged map is refused by name") {
  const test::TemporaryFolder folder;
  write_grid_map(folder.path(), some_map());
  const auto yaml = folder / "map.yaml", image = folder / "map.pgm";
  const auto replace = [&](const std::string& what, const std::string& by) {
    std::string text = read_bytes(yaml);
    write_bytes(yaml, {text.replace(text.find(what), what.size(), by)});
  };
  std::string expected;
  SECTION("image cut off") {
    write_bytes(image, {read_bytes(image).substr(0, 13)});
    expected = "map.pgm: cannot be decoded";
  }
  SECTION("image missing") {
    std::filesystem::remove(image);
    expected = "map.pgm";
  }
  SECTION("yaml missing") {
    std::filesystem::remove(yaml);
    expected = "map.yaml";
  }
  SECTION("another mode") {
    replace("trinary", "raw");
    expected = "map.yaml:2: only the mode trinary is known";
  }
  SECTION("resolution of 0") {
    replace("0.05", "0");
    expected = "map.yaml:3: the resolution must be above 0";
  }
  SECTION("turned map") {
    replace("2, 0]", "2, 0.5]");
    expected = "map.yaml:4: expected an origin [x, y, 0]";
  }
  CHECK_THROWS_WITH(read_grid_map(folder.path()), Contains(expected));
}

TEST_CASE("cells that do not fit the size are not written") {
  const test::TemporaryFolder folder;
  GridMap map = some_map();
  map.cells.pop_back();
  CHECK_THROWS_WITH(write_grid_map(folder.path(), map), Contains("3 x 2 cells expected, 5 found"));
}
