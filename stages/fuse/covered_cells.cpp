#include "stages/fuse/covered_cells.hpp"

#include <algorithm>
#include <cmath>

namespace sediment::fuse {

CoveredCells::Cell CoveredCells::cell_of(const LabelledPoint& point) const {
  const auto index = [&](float value) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(value) * cells_per_metre_));
  };
  return {index(point.x), index(point.y), index(point.z)};
}

/// 21 bits an axis: a scene is smaller than two million cells, and beyond them cells only share a key.
std::uint64_t CoveredCells::key_of(const Cell& cell) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
  return (static_cast<std::uint64_t>(cell.x) & kMask) | (static_cast<std::uint64_t>(cell.y) & kMask) << 21 |
         (static_cast<std::uint64_t>(cell.z) & kMask) << 42;
}

bool CoveredCells::is_near(const Cell& cell) const {
  if (cells_.contains(key_of(cell))) return true;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (cells_.contains(key_of({cell.x + x, cell.y + y, cell.z + z}))) return true;
  return false;
}

void CoveredCells::add(const LabelledCloud& points) {
  for (const LabelledPoint& point : points) cells_.insert(key_of(cell_of(point)));
}

void CoveredCells::keep_new(LabelledCloud& points) {
  std::erase_if(points, [&](const LabelledPoint& point) { return is_near(cell_of(point)); });
  add(points);
}

}  // namespace sediment::fuse
