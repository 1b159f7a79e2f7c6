#include "pipeline/sorting/radix_sort.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

namespace sediment {
namespace {

constexpr int kDigitBits = 8;  // 256 open write streams: more would not fit the first-level cache and the TLB
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr std::size_t kLeastBlock = std::size_t{1} << 15;
constexpr std::size_t kMostBlocks = 64;

using Histogram = std::array<std::size_t, kDigits>;

template <class Key>
std::size_t digit_of(Key key, int shift) {
  return static_cast<std::size_t>(key >> shift) & (kDigits - 1);
}

/// The items split into blocks whose number depends on nothing but how many there are.
struct Blocks {
  explicit Blocks(std::size_t item_count)
      : items(item_count), count(std::clamp<std::size_t>(item_count / kLeastBlock, 1, kMostBlocks)) {}
  std::size_t begin(std::size_t block) const { return items * block / count; }
  std::size_t items, count;
};

template <class Key>
std::vector<Histogram> histograms_of(std::span<const Key> keys, const Blocks& blocks, int shift) {
  std::vector<Histogram> histograms(blocks.count);
  tbb::parallel_for(std::size_t{0}, blocks.count, [&](std::size_t block) {
    Histogram& histogram = histograms[block];
    histogram.fill(0);
    for (std::size_t i = blocks.begin(block); i < blocks.begin(block + 1); ++i)
      ++histogram[digit_of(keys[i], shift)];
  });
  return histograms;
}

/// Turns counts into the place of the first item of each digit and block. False if all have the same digit.
bool counts_to_places(std::vector<Histogram>& histograms, std::size_t item_count) {
  std::size_t place = 0;
  for (std::size_t digit = 0; digit < kDigits; ++digit) {
    const std::size_t before = place;
    for (Histogram& histogram : histograms) {
      const std::size_t count = histogram[digit];
      histogram[digit] = place;
      place += count;
    }
    if (place - before == item_count) return false;
  }
  return true;
}

template <class Key>
void sort_digits(std::vector<Key>& keys, std::vector<std::uint32_t>& values, int key_bits) {
  if (keys.size() != values.size())
    throw std::invalid_argument("sort_by_key: as many values as keys are needed");
  const Blocks blocks(keys.size());
  std::vector<Key> next_keys(keys.size());
  std::vector<std::uint32_t> next_values(keys.size());
  for (int shift = 0; shift < key_bits; shift += kDigitBits) {
    std::vector<Histogram> places = histograms_of<Key>(keys, blocks, shift);
    if (!counts_to_places(places, keys.size())) continue;
    tbb::parallel_for(std::size_t{0}, blocks.count, [&](std::size_t block) {
      Histogram& place = places[block];
      for (std::size_t i = blocks.begin(block); i < blocks.begin(block + 1); ++i) {
        const std::size_t to = place[digit_of(keys[i], shift)]++;
        next_keys[to] = keys[i];
        next_values[to] = values[i];
      }
    });
    keys.swap(next_keys);
    values.swap(next_values);
  }
}

}  // namespace

void sort_by_key(std::vector<std::uint32_t>& keys, std::vector<std::uint32_t>& values, int key_bits) {
  sort_digits(keys, values, key_bits);
}

void sort_by_key(std::vector<std::uint64_t>& keys, std::vector<std::uint32_t>& values, int key_bits) {
  sort_digits(keys, values, key_bits);
}

}  // namespace sediment
