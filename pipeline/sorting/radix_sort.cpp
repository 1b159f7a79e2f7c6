#include "pipeline/sorting/radix_sort.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <stdexcept>

namespace sediment {
namespace {

/// More items are sorted by 8 bits at a time: 256 open write streams fit the first-level cache and the TLB.
/// Fewer stay in the second-level cache anyway, and longer digits save passes.
constexpr std::size_t kManyItems = std::size_t{1} << 16;
constexpr std::size_t kLeastBlock = std::size_t{1} << 15;
constexpr std::size_t kMostBlocks = 64;

using Histogram = std::vector<std::size_t>;

/// The bits that one pass sorts by.
struct Digit {
  int shift, bits;

  std::size_t values() const { return std::size_t{1} << bits; }
  template <class Key>
  std::size_t of(Key key) const {
    return static_cast<std::size_t>(key >> shift) & (values() - 1);
  }
};

/// Digits of about equal length, the lowest first.
std::vector<Digit> digits_of(int key_bits, std::size_t items) {
  const int longest = items > kManyItems ? 8 : 11, passes = (key_bits + longest - 1) / longest;
  std::vector<Digit> digits;
  for (int pass = 0, shift = 0; pass < passes; ++pass) {
    digits.push_back({shift, (key_bits - shift + passes - pass - 1) / (passes - pass)});
    shift += digits.back().bits;
  }
  return digits;
}

/// The items split into blocks whose number depends on nothing but how many there are.
struct Blocks {
  explicit Blocks(std::size_t item_count)
      : items(item_count), count(std::clamp<std::size_t>(item_count / kLeastBlock, 1, kMostBlocks)) {}
  std::size_t begin(std::size_t block) const { return items * block / count; }
  std::size_t items, count;
};

template <class Key>
std::vector<Histogram> histograms_of(std::span<const Key> keys, const Blocks& blocks, Digit digit) {
  std::vector<Histogram> histograms(blocks.count);
  tbb::parallel_for(std::size_t{0}, blocks.count, [&](std::size_t block) {
    Histogram& histogram = histograms[block];
    histogram.assign(digit.values(), 0);
    for (std::size_t i = blocks.begin(block); i < blocks.begin(block + 1); ++i)
      ++histogram[digit.of(keys[i])];
  });
  return histograms;
}

/// Turns counts into the place of the first item of each digit and block. False if all have the same digit.
bool counts_to_places(std::vector<Histogram>& histograms, std::size_t item_count) {
  std::size_t place = 0;
  for (std::size_t digit = 0; digit < histograms[0].size(); ++digit) {
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
  for (const Digit digit : digits_of(key_bits, keys.size())) {
    std::vector<Histogram> places = histograms_of<Key>(keys, blocks, digit);
    if (!counts_to_places(places, keys.size())) continue;
    tbb::parallel_for(std::size_t{0}, blocks.count, [&](std::size_t block) {
      Histogram& place = places[block];
      for (std::size_t i = blocks.begin(block); i < blocks.begin(block + 1); ++i) {
        const std::size_t to = place[digit.of(keys[i])]++;
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
