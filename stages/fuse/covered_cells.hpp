#pragma once

#include <cstdint>
#include <unordered_map>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::fuse {

/// Which cubes of space have a point of the map already, or are beside one that has. Memory grows with the
/// scene, not with the sequence.
class CoveredCells {
 public:
  explicit CoveredCells(double side_m) : cells_per_metre_(1 / side_m) {}

  void add(const LabelledCloud& points);

  /// Leaves only the points that no earlier one is near: none in the point's cube, nor in the 26 around it.
  /// Points of `points` do not count as earlier. Those that stay are added.
  void keep_new(LabelledCloud& points);

 private:
  struct Cell {
    std::int64_t x, y, z;
  };
  /// 4 x 4 x 4 cells, a bit each.
  struct Block {
    std::uint64_t filled = 0, near = 0;
  };
  Cell cell_of(const LabelledPoint& point) const;
  static std::uint64_t block_of(const Cell& cell);
  static std::uint64_t bit_of(const Cell& cell);
  bool is_near(const Cell& cell) const;
  void fill(const Cell& cell);

  double cells_per_metre_;
  std::unordered_map<std::uint64_t, Block> blocks_;
};

}  // namespace sediment::fuse
