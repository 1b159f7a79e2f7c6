#include "stages/project2d/grid_rules.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace sediment::project2d {
namespace {

/// Whether one of the 8 cells around is of a kind.
bool has_near(const GridMap& map, int x, int y, Cell kind) {
  for (int ny = std::max(0, y - 1); ny <= std::min(map.height - 1, y + 1); ++ny)
    for (int nx = std::max(0, x - 1); nx <= std::min(map.width - 1, x + 1); ++nx)
      if ((nx != x || ny != y) && map.at(nx, ny) == kind) return true;
  return false;
}

/// Whether each of the nine squares of 3 x 3 cells that hold an unknown cell has a free one.
bool is_notch(const GridMap& map, int x, int y) {
  for (int ny = y - 1; ny <= y + 1; ++ny)
    for (int nx = x - 1; nx <= x + 1; ++nx)
      if (map.at(nx, ny) != Cell::free && !has_near(map, nx, ny, Cell::free)) return false;
  return true;
}

/// The unknown cells that hang together with a first one, and whether only free cells are around them.
struct Hole {
  std::vector<std::size_t> cells;
  bool among_free = true;
};

Hole trace(const GridMap& map, std::size_t first, std::vector<char>& visited) {
  Hole hole{{first}, true};
  visited[first] = 1;
  for (std::size_t i = 0; i < hole.cells.size(); ++i) {
    const int x = static_cast<int>(hole.cells[i] % map.width),
              y = static_cast<int>(hole.cells[i] / map.width);
    for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int nx = x + dx, ny = y + dy;
      if (nx < 0 || ny < 0 || nx >= map.width || ny >= map.height) {
        hole.among_free = false;
        continue;
      }
      const std::size_t next = static_cast<std::size_t>(ny) * map.width + nx;
      if (map.cells[next] == Cell::occupied) hole.among_free = false;
      if (map.cells[next] != Cell::unknown || visited[next] != 0) continue;
      visited[next] = 1;
      hole.cells.push_back(next);
    }
  }
  return hole;
}

}  // namespace

std::size_t remove_speckle(GridMap& map, std::span<const std::int32_t> in_band, int least_points) {
  std::vector<std::size_t> speckle;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * map.width + x;
      if (map.cells[i] == Cell::occupied && in_band[i] < least_points && !has_near(map, x, y, Cell::occupied))
        speckle.push_back(i);
    }
  for (const std::size_t i : speckle) map.cells[i] = Cell::unknown;
  return speckle.size();
}

std::size_t fill_holes(GridMap& map, int most_cells) {
  std::size_t filled = 0;
  if (most_cells <= 0) return 0;
  std::vector<char> visited(map.cells.size(), 0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] != Cell::unknown || visited[i] != 0) continue;
    const Hole hole = trace(map, i, visited);
    if (!hole.among_free || hole.cells.size() > static_cast<std::size_t>(most_cells)) continue;
    for (const std::size_t cell : hole.cells) map.cells[cell] = Cell::free;
    filled += hole.cells.size();
  }
  return filled;
}

std::size_t close_notches(GridMap& map) {
  std::vector<std::size_t> notches;
  for (int y = 1; y + 1 < map.height; ++y)
    for (int x = 1; x + 1 < map.width; ++x)
      if (map.at(x, y) == Cell::unknown && !has_near(map, x, y, Cell::occupied) && is_notch(map, x, y))
        notches.push_back(static_cast<std::size_t>(y) * map.width + x);
  for (const std::size_t i : notches) map.cells[i] = Cell::free;
  return notches.size();
}

}  // namespace sediment::project2d
