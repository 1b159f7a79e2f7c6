#pragma once

#include <cstdint>

namespace sediment::synthetic {

/// Counter-based random numbers: a value depends on its coordinates alone, never on the order in which values
/// are drawn, so that threads cannot change a picture.
constexpr std::uint64_t mix(std::uint64_t x) {  // finaliser of splitmix64 (Steele, Lea, Flood 2014)
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

constexpr std::uint64_t hash(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) {
  return mix(mix(mix(seed ^ a * 0xd1342543de82ef95u) ^ b * 0xaf251af3b0f025b5u) ^ c);
}

/// The upper 53 bits as a number in [0, 1).
inline double unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// A sequence of numbers for building things one after the other.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}
  std::uint64_t next() { return hash(seed_, ++count_); }
  double uniform(double low = 0, double high = 1) { return low + (high - low) * unit(next()); }
  int integer(int low, int high) {  // inclusive
    return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::uint64_t seed_, count_ = 0;
};

}  // namespace sediment::synthetic
