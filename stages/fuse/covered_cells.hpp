#pragma once

#include <cstdint>
#include <unordered_set>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::fuse {

/// Which cubes of space have a point of the map already. Memory grows with the scene, not with the sequence.
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
  Cell cell_of(const LabelledPoint& point) const;
  static std::uint64_t key_of(const Cell& cell);
  bool is_near(const Cell& cell) const;

  double cells_per_metre_;
  std::unordered_set<std::uint64_t> cells_;
};

}  // namespace sediment::fuse
