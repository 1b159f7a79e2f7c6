#include "stages/fuse/covered_cells.hpp"

#include <cmath>

namespace sediment::fuse {

CoveredCells::Cell CoveredCells::cell_of(const LabelledPoint& point) const {
  const auto index = [&](float value) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(value) * cells_per_metre_));
  };
  return {index(point.x), index(point.y), index(point.z)};
}

/// 21 bits an axis: a scene is smaller than eight million cells, and beyond them blocks only share a key.
std::uint64_t CoveredCells::block_of(const Cell& cell) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
  const auto part = [](std::int64_t index) { return static_cast<std::uint64_t>(index >> 2) & kMask; };
  return part(cell.x) | part(cell.y) << 21 | part(cell.z) << 42;
}

std::uint64_t CoveredCells::bit_of(const Cell& cell) {
  return std::uint64_t{1} << ((cell.x & 3) | (cell.y & 3) << 2 | (cell.z & 3) << 4);
}

bool CoveredCells::is_near(const Cell& cell) const {
  const auto block = blocks_.find(block_of(cell));
  return block != blocks_.end() && (block->second.near & bit_of(cell));
}

void CoveredCells::fill(const Cell& cell) {
  Block& block = blocks_[block_of(cell)];
  if (block.filled & bit_of(cell)) return;
  block.filled |= bit_of(cell);
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const Cell beside{cell.x + x, cell.y + y, cell.z + z};
        blocks_[block_of(beside)].near |= bit_of(beside);
      }
}

void CoveredCells::add(const LabelledCloud& points) {
  for (const LabelledPoint& point : points) fill(cell_of(point));
}

void CoveredCells::keep_new(LabelledCloud& points) {
  std::erase_if(points, [&](const LabelledPoint& point) { return is_near(cell_of(point)); });
  add(points);
}

}  // namespace sediment::fuse
