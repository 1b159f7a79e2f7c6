#include "stages/octree/radix_sort.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>

namespace sediment::octree {
namespace {

constexpr int kDigitBits = 9;
constexpr std::size_t kBuckets = std::size_t{1} << kDigitBits;
/// Pieces of the work: a fixed number, so that neither result nor layout depends on the threads.
constexpr std::size_t kChunks = 16;
constexpr int kOctantShift = 3 * (kTreeDepth - 1);

/// Bits [shift, shift + bits) of a code.
struct Digit {
  int shift = 0, bits = 0;
  std::size_t of(std::uint64_t code) const { return (code >> shift) & ((std::uint64_t{1} << bits) - 1); }
};

template <class Work>
void for_each_chunk(std::size_t size, const Work& work) {
  tbb::parallel_for(std::size_t{0}, kChunks, [&](std::size_t chunk) {
    work(chunk, size * chunk / kChunks, size * (chunk + 1) / kChunks);
  });
}

/// The digits in which codes differ, lowest first. A scene is small beside the tree, and the origin is in the
/// middle of it: so within each of the eight octants the upper bits are all the same, and the bits in between
/// need no pass.
std::vector<Digit> digits_of(const std::vector<LeafPoint>& points) {
  std::array<std::array<std::uint64_t, 8>, kChunks> any{}, all{};
  for (auto& octants : all) octants.fill(~std::uint64_t{0});
  for_each_chunk(points.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      any[chunk][points[i].code >> kOctantShift] |= points[i].code;
      all[chunk][points[i].code >> kOctantShift] &= points[i].code;
    }
  });
  std::uint64_t varying = 0;
  for (std::size_t octant = 0; octant < 8; ++octant) {
    std::uint64_t any_of_octant = 0, all_of_octant = ~std::uint64_t{0};
    for (std::size_t chunk = 0; chunk < kChunks; ++chunk) {
      any_of_octant |= any[chunk][octant];
      all_of_octant &= all[chunk][octant];
    }
    varying |= any_of_octant & ~all_of_octant;
  }
  std::vector<Digit> digits;
  const int bits = std::bit_width(varying), passes = (bits + kDigitBits - 1) / kDigitBits;
  for (int pass = 0; pass < passes; ++pass) {
    const int from = bits * pass / passes, to = bits * (pass + 1) / passes;
    digits.push_back({from, to - from});
  }
  digits.push_back({kOctantShift, 3});
  return digits;
}

void scatter(const std::vector<LeafPoint>& from, std::vector<LeafPoint>& to, Digit digit) {
  std::vector<std::array<std::size_t, kBuckets>> next(kChunks);
  for_each_chunk(from.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    next[chunk].fill(0);
    for (std::size_t i = begin; i < end; ++i) ++next[chunk][digit.of(from[i].code)];
  });
  std::size_t at = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket)
    for (auto& counts : next) at += std::exchange(counts[bucket], at);
  for_each_chunk(from.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) to[next[chunk][digit.of(from[i].code)]++] = from[i];
  });
}

}  // namespace

void sort_by_code(std::vector<LeafPoint>& points) {
  if (points.empty()) return;
  std::vector<LeafPoint> other(points.size());
  for (const Digit digit : digits_of(points)) {
    scatter(points, other, digit);
    points.swap(other);
  }
}

}  // namespace sediment::octree
