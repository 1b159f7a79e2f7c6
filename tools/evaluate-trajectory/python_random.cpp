#include "tools/evaluate-trajectory/python_random.hpp"

namespace sediment::tools {
namespace {

constexpr std::size_t kWords = 624, kShift = 397;

std::uint32_t mixed(std::uint32_t word) {
  return word ^ (word >> 30);
}

}  // namespace

PythonRandom::PythonRandom(std::uint32_t seed) {
  // init_genrand(19650218), then init_by_array({seed}).
  state_[0] = 19650218u;
  for (std::uint32_t i = 1; i < kWords; ++i) state_[i] = 1812433253u * mixed(state_[i - 1]) + i;
  std::size_t i = 1;
  const auto wrap = [&] {
    if (++i < kWords) return;
    state_[0] = state_[kWords - 1];
    i = 1;
  };
  for (std::size_t k = 0; k < kWords; ++k, wrap())
    state_[i] = (state_[i] ^ mixed(state_[i - 1]) * 1664525u) + seed;
  for (std::size_t k = 0; k < kWords - 1; ++k, wrap())
    state_[i] = (state_[i] ^ mixed(state_[i - 1]) * 1566083941u) - static_cast<std::uint32_t>(i);
  state_[0] = 0x80000000u;
}

std::uint32_t PythonRandom::next() {
  if (position_ == kWords) {
    for (std::size_t k = 0; k < kWords; ++k) {
      const std::uint32_t joined = (state_[k] & 0x80000000u) | (state_[(k + 1) % kWords] & 0x7fffffffu);
      state_[k] = state_[(k + kShift) % kWords] ^ (joined >> 1) ^ ((joined & 1) != 0 ? 0x9908b0dfu : 0);
    }
    position_ = 0;
  }
  std::uint32_t word = state_[position_++];
  word ^= word >> 11;
  word ^= (word << 7) & 0x9d2c5680u;
  word ^= (word << 15) & 0xefc60000u;
  return word ^ (word >> 18);
}

double PythonRandom::uniform() {
  const double high = next() >> 5, low = next() >> 6;
  return (high * 67108864.0 + low) / 9007199254740992.0;
}

std::size_t PythonRandom::index_up_to(std::size_t last) {
  return static_cast<std::size_t>(uniform() * static_cast<double>(last + 1));
}

}  // namespace sediment::tools
