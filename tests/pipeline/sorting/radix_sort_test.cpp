#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "pipeline/sorting/radix_sort.hpp"

using namespace sediment;

namespace {

std::vector<std::uint32_t> counting(std::size_t size) {
  std::vector<std::uint32_t> values(size);
  std::iota(values.begin(), values.end(), 0u);
  return values;
}

template <class Key>
void check_against_stable_sort(const std::vector<Key>& keys, int key_bits) {
  std::vector<std::uint32_t> expected = counting(keys.size());
  std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
  std::vector<Key> sorted = keys;
  std::vector<std::uint32_t> values = counting(keys.size());
  sort_by_key(sorted, values, key_bits);
  CHECK(values == expected);
  CHECK(std::is_sorted(sorted.begin(), sorted.end()));
}

}  // namespace

TEST_CASE("sorting by key is the stable sort of the standard library") {
  const std::size_t size = GENERATE(0u, 1u, 2u, 255u, 70000u, 300001u);
  const int bits = GENERATE(1, 7, 20, 43, 64);
  std::mt19937_64 random(size + static_cast<std::size_t>(bits));
  std::vector<std::uint64_t> keys(size);
  for (auto& key : keys) key = bits == 64 ? random() : random() & ((std::uint64_t{1} << bits) - 1);
  check_against_stable_sort(keys, bits);
  check_against_stable_sort(std::vector<std::uint32_t>(keys.begin(), keys.end()), std::min(bits, 32));
}

TEST_CASE("sorting by key does not depend on the number of threads") {
  std::mt19937 random(1);
  std::vector<std::uint32_t> keys(500000);
  for (auto& key : keys) key = random() % 1000;
  std::vector<std::vector<std::uint32_t>> results;
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    auto sorted = keys;
    auto values = counting(keys.size());
    sort_by_key(sorted, values);
    results.push_back(values);
  }
  CHECK(results[0] == results[1]);
}

TEST_CASE("keys and values of different number are refused") {
  std::vector<std::uint32_t> keys(3), values(2);
  CHECK_THROWS_AS(sort_by_key(keys, values), std::invalid_argument);
}
