#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "stages/octree/frame_cells.hpp"

namespace octomap {
class AbstractOccupancyOcTree;
}

namespace sediment::octree {

/// A cube of space about which rays say the same everywhere: its size is that of a node at `depth`.
struct SpaceCell {
  std::uint64_t code = 0;  ///< of its first smallest cell
  float log_odds = 0;
  std::uint8_t depth = kTreeDepth;

  friend bool operator==(const SpaceCell&, const SpaceCell&) = default;
};

/// Log-odds of all cells that rays have met, updated once a cell and frame as OctoMap's updateNode does it:
/// hit or miss added in the order of the frames, clamped each time.
class RayMap {
 public:
  /// With the probabilities and clamping thresholds of a tree.
  explicit RayMap(const octomap::AbstractOccupancyOcTree& model);

  void add(std::span<const Brick> frame);

  /// In the order of their codes; equal neighbours that fill a node are one.
  std::vector<SpaceCell> cells() const;

 private:
  /// Row by row: cell (x, y, z) of the brick is at 64 z + 8 y + x.
  struct LogOdds {
    std::array<float, 512> values{};
    std::array<std::uint64_t, 8> known{};
  };
  using RowSteps = std::array<std::array<float, 8>, 256>;

  float lowest_, highest_;
  RowSteps hits_, misses_;  ///< what to add to a row of eight cells, by its byte of the mask
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::vector<std::unique_ptr<LogOdds>> bricks_;
};

/// Only what is free. A node at `max_depth` that some ray found occupied is neither free nor known: the
/// cloud, which was cleaned, says what is occupied.
std::vector<SpaceCell> free_cells(std::span<const SpaceCell> cells, int max_depth);

}  // namespace sediment::octree
