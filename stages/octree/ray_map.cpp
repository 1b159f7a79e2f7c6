#include "stages/octree/ray_map.hpp"

#include <octomap/AbstractOccupancyOcTree.h>

#include <algorithm>

namespace sediment::octree {
namespace {

constexpr int kBrickDepth = kTreeDepth - 3;

/// Position in a brick of its cells in the order of their codes.
std::array<std::uint16_t, 512> row_order() {
  std::array<std::uint16_t, 512> order{};
  for (std::uint64_t code = 0; code < 512; ++code) {
    const Keys at = keys_of(code);
    order[code] = static_cast<std::uint16_t>(64 * at.z + 8 * at.y + at.x);
  }
  return order;
}

/// The cells of one brick in the order of their codes.
struct CodedBrick {
  std::uint64_t code = 0;  ///< of its first cell
  std::array<float, 512> values{};
  std::array<bool, 512> known{};

  bool is_uniform(std::size_t first, std::size_t count) const {
    for (std::size_t i = first; i < first + count; ++i)
      if (!known[i] || values[i] != values[first]) return false;
    return true;
  }

  void append(std::size_t first, int depth, std::vector<SpaceCell>& cells) const {
    const std::size_t count = std::size_t{1} << 3 * (kTreeDepth - depth);
    if (is_uniform(first, count)) {
      cells.push_back({code + first, values[first], static_cast<std::uint8_t>(depth)});
    } else if (depth < kTreeDepth) {
      for (std::size_t child = 0; child < 8; ++child) append(first + child * count / 8, depth + 1, cells);
    }
  }
};

}  // namespace

RayMap::RayMap(const octomap::AbstractOccupancyOcTree& model)
    : lowest_(model.getClampingThresMinLog()), highest_(model.getClampingThresMaxLog()) {
  for (std::size_t mask = 0; mask < 256; ++mask)
    for (std::size_t x = 0; x < 8; ++x) {
      const bool set = (mask >> x & 1) != 0;
      hits_[mask][x] = set ? model.getProbHitLog() : 0;
      misses_[mask][x] = set ? model.getProbMissLog() : 0;
    }
}

void RayMap::add(std::span<const Brick> frame) {
  for (const Brick& brick : frame) {
    const auto [known, is_new] = index_.try_emplace(brick.code, bricks_.size());
    if (is_new) bricks_.push_back(std::make_unique<LogOdds>());
    LogOdds& log_odds = *bricks_[known->second];
    for (int z = 0; z < 8; ++z) {
      const std::uint64_t any = brick.free[z] | brick.occupied[z];
      if (any == 0) continue;
      log_odds.known[z] |= any;
      for (int y = 0; y < 8; ++y) {
        const auto& miss = misses_[brick.free[z] >> 8 * y & 255];
        const auto& hit = hits_[brick.occupied[z] >> 8 * y & 255];
        float* row = log_odds.values.data() + 64 * z + 8 * y;
        for (int x = 0; x < 8; ++x)
          row[x] = std::min(std::max(row[x] + (miss[x] + hit[x]), lowest_), highest_);
      }
    }
  }
}

std::vector<SpaceCell> RayMap::cells() const {
  static const std::array<std::uint16_t, 512> kOrder = row_order();
  std::vector<std::pair<std::uint64_t, std::size_t>> sorted(index_.begin(), index_.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<SpaceCell> cells;
  for (const auto& [code, at] : sorted) {
    CodedBrick brick;
    brick.code = code << 9;
    for (std::size_t i = 0; i < 512; ++i) {
      const std::size_t cell = kOrder[i];
      brick.values[i] = bricks_[at]->values[cell];
      brick.known[i] = (bricks_[at]->known[cell / 64] >> cell % 64 & 1) != 0;
    }
    brick.append(0, kBrickDepth, cells);
  }
  return cells;
}

std::vector<SpaceCell> free_cells(std::span<const SpaceCell> cells, int max_depth) {
  std::vector<SpaceCell> free;
  for (std::size_t first = 0, end = 0; first < cells.size(); first = end) {
    const int shift = 3 * (kTreeDepth - std::min<int>(max_depth, cells[first].depth));
    float most = cells[first].log_odds;
    for (end = first + 1; end < cells.size() && cells[end].code >> shift == cells[first].code >> shift; ++end)
      most = std::max(most, cells[end].log_odds);
    if (most < 0) free.insert(free.end(), cells.begin() + first, cells.begin() + end);
  }
  return free;
}

}  // namespace sediment::octree
