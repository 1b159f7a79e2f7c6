#include "stages/sor/spatial_order.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "pipeline/sorting/radix_sort.hpp"

namespace sediment::sor {
namespace {

constexpr int kBitsPerAxis = 16;
constexpr int kKeyBits = 3 * kBitsPerAxis;

using Indices = std::vector<std::uint32_t>;
using Range = tbb::blocked_range<std::size_t>;

/// Longest side in metres.
double extent_of(const Box& box) {
  const auto along = [](float low, float high) { return static_cast<double>(high) - low; };
  return std::max({along(box.min.x, box.max.x), along(box.min.y, box.max.y), along(box.min.z, box.max.z)});
}

Box bounds_of(std::span<const Position> points, const Indices& indices) {
  return tbb::parallel_reduce(
      Range(0, indices.size(), 1 << 14), Box{},
      [&](const Range& range, Box bounds) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) bounds.add(points[indices[i]]);
        return bounds;
      },
      [](Box a, const Box& b) {
        a.add(b);
        return a;
      });
}

/// Spreads the lowest 16 bits to every third bit.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ff0000ffull;
  bits = (bits | bits << 8) & 0x00f00f00f00full;
  bits = (bits | bits << 4) & 0x0c30c30c30c3ull;
  return (bits | bits << 2) & 0x249249249249ull;
}

/// Morton keys over a cube that begins at the lower corner of the bounds.
std::vector<std::uint64_t> morton_keys(std::span<const Position> points, const Indices& indices,
                                       const Box& bounds) {
  constexpr double kLastCell = (1 << kBitsPerAxis) - 1;
  const double cells_per_metre = kLastCell / extent_of(bounds);
  const auto cell = [&](float value, float origin) {
    return static_cast<std::uint64_t>(
        std::min((static_cast<double>(value) - origin) * cells_per_metre, kLastCell));
  };
  std::vector<std::uint64_t> keys(indices.size());
  tbb::parallel_for(Range(0, indices.size(), 1 << 14), [&](const Range& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Position& p = points[indices[i]];
      keys[i] = spread(cell(p.x, bounds.min.x)) | spread(cell(p.y, bounds.min.y)) << 1 |
                spread(cell(p.z, bounds.min.z)) << 2;
    }
  });
  return keys;
}

/// A piece of the curve. `full`: more points than a leaf may have, in one cell of the finest level.
struct Piece {
  std::size_t begin, end;
  bool full;
};

/// Cuts [begin, end) of the sorted keys where their highest differing bit changes until the pieces are small
/// enough.
void cut(const std::vector<std::uint64_t>& keys, std::size_t begin, std::size_t end, std::size_t leaf_points,
         std::vector<Piece>& pieces) {
  const bool small = end - begin <= leaf_points;
  const std::uint64_t difference = keys[begin] ^ keys[end - 1];
  if (small || difference == 0) {
    pieces.push_back({begin, end, !small});
    return;
  }
  const std::uint64_t bit = std::bit_floor(difference);
  const auto middle = std::partition_point(keys.begin() + static_cast<std::ptrdiff_t>(begin),
                                           keys.begin() + static_cast<std::ptrdiff_t>(end),
                                           [bit](std::uint64_t key) { return (key & bit) == 0; });
  const auto split = static_cast<std::size_t>(middle - keys.begin());
  cut(keys, begin, split, leaf_points, pieces);
  cut(keys, split, end, leaf_points, pieces);
}

/// Orders `indices` in place and returns the ends of its leaves.
Indices order_and_cut(std::span<const Position> points, Indices& indices, std::size_t leaf_points) {
  const Box bounds = bounds_of(points, indices);
  if (indices.size() <= leaf_points || extent_of(bounds) == 0)
    return {static_cast<std::uint32_t>(indices.size())};
  std::vector<std::uint64_t> keys = morton_keys(points, indices, bounds);
  sort_by_key(keys, indices, kKeyBits);
  std::vector<Piece> pieces;
  cut(keys, 0, keys.size(), leaf_points, pieces);

  std::vector<Indices> inner_ends(pieces.size());
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
    if (!pieces[i].full) return;
    const auto first = indices.begin() + static_cast<std::ptrdiff_t>(pieces[i].begin);
    const auto last = indices.begin() + static_cast<std::ptrdiff_t>(pieces[i].end);
    Indices inner(first, last);
    inner_ends[i] = order_and_cut(points, inner, leaf_points);
    std::copy(inner.begin(), inner.end(), first);
  });

  Indices ends;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const std::uint32_t end : inner_ends[i])
      ends.push_back(static_cast<std::uint32_t>(pieces[i].begin) + end);
    if (!pieces[i].full) ends.push_back(static_cast<std::uint32_t>(pieces[i].end));
  }
  return ends;
}

}  // namespace

SpatialOrder spatial_order(std::span<const Position> points, std::size_t leaf_points) {
  SpatialOrder order;
  order.point_idx.resize(points.size());
  std::iota(order.point_idx.begin(), order.point_idx.end(), 0u);
  order.leaf_begin.push_back(0);
  if (points.empty()) return order;
  const Indices ends = order_and_cut(points, order.point_idx, leaf_points);
  order.leaf_begin.insert(order.leaf_begin.end(), ends.begin(), ends.end());
  return order;
}

}  // namespace sediment::sor
