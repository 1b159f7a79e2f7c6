#pragma once

#include <cstdint>
#include <vector>

namespace sediment {

/// Sorts `keys` in ascending order and moves `values` along: stable, in parallel, the same at any thread
/// count. `values` says which point a key belongs to. Only the lowest `key_bits` bits are looked at. Needs
/// room for a second copy of both. Throws std::invalid_argument if the sizes differ.
void sort_by_key(std::vector<std::uint32_t>& keys, std::vector<std::uint32_t>& values, int key_bits = 32);
void sort_by_key(std::vector<std::uint64_t>& keys, std::vector<std::uint32_t>& values, int key_bits = 64);

}  // namespace sediment
