#include "tools/evaluate-map/grid_score.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/truth/share.hpp"

namespace sediment::tools {
namespace {

/// What is true of the cells of a map. `rested`: something stood there for a while only; a map may show it or
/// not.
struct TrueCells {
  std::vector<char> occupied, ground, seen_through, rested;
};

struct CellIndex {
  const GridMap& map;

  /// Position in `cells`, none outside the map.
  std::optional<std::size_t> of(Vec3 in_map) const {
    const double x = std::floor((in_map.x - map.origin_x_m) / map.resolution_m);
    const double y = std::floor((in_map.y - map.origin_y_m) / map.resolution_m);
    if (x < 0 || y < 0 || x >= map.width || y >= map.height) return std::nullopt;
    return static_cast<std::size_t>(y) * map.width + static_cast<std::size_t>(x);
  }
};

TrueCells true_cells(const GridMap& map, const Pose& map_from_truth, const std::vector<Vec3>& still,
                     const std::vector<Vec3>& surface, const FreeSpace& free, const HeightBand& band) {
  const CellIndex index{map};
  TrueCells cells{std::vector<char>(map.cells.size(), 0), {}, {}, {}};
  cells.ground = cells.seen_through = cells.rested = cells.occupied;
  const auto mark = [&](const std::vector<Vec3>& points, std::vector<char>& marked) {
    for (const Vec3& point : points)
      if (point.z >= band.low_m && point.z <= band.high_m)
        if (const auto cell = index.of(map_from_truth * point)) marked[*cell] = 1;
  };
  mark(still, cells.occupied);
  mark(surface, cells.rested);
  for (std::size_t i = 0; i < cells.rested.size(); ++i)
    if (cells.occupied[i] != 0) cells.rested[i] = 0;
  for (const Vec3& point : still)
    if (std::abs(point.z) < band.low_m)
      if (const auto cell = index.of(map_from_truth * point)) cells.ground[*cell] = 1;
  const Pose truth_from_map = map_from_truth.inverse();
  tbb::parallel_for(0, map.height, [&](int y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t cell = static_cast<std::size_t>(y) * map.width + x;
      if (cells.occupied[cell] != 0) continue;
      for (double z = band.low_m + 0.05; z < band.high_m && cells.seen_through[cell] == 0; z += 0.1)
        cells.seen_through[cell] =
            free.contains(truth_from_map * Vec3{map.origin_x_m + (x + 0.5) * map.resolution_m,
                                                map.origin_y_m + (y + 0.5) * map.resolution_m, z});
    }
  });
  return cells;
}

/// Whether a cell or one of the 8 around it is set.
template <class IsSet>
bool near(const GridMap& map, int x, int y, const IsSet& is_set) {
  for (int ny = std::max(0, y - 1); ny <= std::min(map.height - 1, y + 1); ++ny)
    for (int nx = std::max(0, x - 1); nx <= std::min(map.width - 1, x + 1); ++nx)
      if (is_set(static_cast<std::size_t>(ny) * map.width + nx)) return true;
  return false;
}

void count_state(GridScore& score, Cell cell) {
  score.free += cell == Cell::free;
  score.occupied += cell == Cell::occupied;
  score.unknown += cell == Cell::unknown;
}

void count(GridScore& score, const GridMap& map, const TrueCells& truth) {
  std::size_t known_free = 0, safe = 0, right = 0, free_of_ground = 0, found_of_ground = 0, unobserved = 0;
  std::size_t judged_occupied = 0, right_occupied = 0, found_occupied = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * map.width + x;
      const bool occupied = truth.occupied[i] != 0;
      const bool free = !occupied && (truth.ground[i] != 0 || truth.seen_through[i] != 0);
      const bool near_obstacle =
          near(map, x, y, [&](std::size_t k) { return map.cells[k] == Cell::occupied; });
      const bool near_truth =
          near(map, x, y, [&](std::size_t k) { return truth.occupied[k] != 0 || truth.rested[k] != 0; });
      if (truth.rested[i] != 0) {
        count_state(score, map.cells[i]);
        continue;
      }
      score.true_occupied += occupied;
      score.true_free += free;
      found_occupied += occupied && near_obstacle;
      if (!occupied && truth.ground[i] != 0) {
        ++free_of_ground;
        found_of_ground += map.cells[i] == Cell::free;
      }
      count_state(score, map.cells[i]);
      if (map.cells[i] == Cell::free) {
        unobserved += !occupied && !free;
        known_free += occupied || free;
        right += free;
        safe += free || (occupied && near_obstacle);
      } else if (map.cells[i] == Cell::occupied) {
        judged_occupied += occupied || free || near_truth;
        right_occupied += near_truth;
      }
    }
  score.free_precision = share(safe, known_free);
  score.free_precision_strict = share(right, known_free);
  score.free_recall = share(found_of_ground, free_of_ground);
  score.free_unobserved = share(unobserved, score.free);
  score.occupied_precision = share(right_occupied, judged_occupied);
  score.occupied_recall = share(found_occupied, score.true_occupied);
}

}  // namespace

GridScore grid_score(const GridMap& map, const Pose& truth_from_world, const std::vector<Vec3>& still,
                     const std::vector<Vec3>& surface, const FreeSpace& free, const HeightBand& band) {
  const Pose truth_from_map = truth_from_world * map.map_from_world.inverse();
  // Heights are those of the truth, so that a map whose ground is wrong is found wrong; cells are those of
  // the map.
  const Pose map_from_truth = truth_from_map.inverse();
  GridScore score;
  const Vec3 up = truth_from_map.rotate({0, 0, 1});
  score.tilt_deg = std::acos(std::clamp(up.z, -1.0, 1.0)) * 180 / std::numbers::pi;
  const Vec3 middle{map.origin_x_m + map.width * map.resolution_m / 2,
                    map.origin_y_m + map.height * map.resolution_m / 2, 0};
  score.ground_offset_m = (truth_from_map * middle).z;
  count(score, map, true_cells(map, map_from_truth, still, surface, free, band));
  return score;
}

}  // namespace sediment::tools
