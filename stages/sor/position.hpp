#pragma once

#include <algorithm>
#include <limits>

namespace sediment::sor {

/// A position, metres.
struct Position {
  float x = 0, y = 0, z = 0;
};

/// Axis-aligned box, metres. Empty as long as nothing was added.
struct Box {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Position min{kInfinity, kInfinity, kInfinity}, max{-kInfinity, -kInfinity, -kInfinity};

  void add(const Position& p) { add(Box{p, p}); }
  void add(const Box& b) {
    min = {std::min(min.x, b.min.x), std::min(min.y, b.min.y), std::min(min.z, b.min.z)};
    max = {std::max(max.x, b.max.x), std::max(max.y, b.max.y), std::max(max.z, b.max.z)};
  }
  /// All that was added lies at one place.
  bool is_point() const { return min.x == max.x && min.y == max.y && min.z == max.z; }
};

}  // namespace sediment::sor
