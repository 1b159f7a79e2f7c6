#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sediment::tools {

/// The random numbers of Python's module `random` after random.seed(n) with a small n >= 0: a Mersenne
/// twister (Matsumoto and Nishimura 1998) seeded by an array of one word.
class PythonRandom {
 public:
  explicit PythonRandom(std::uint32_t seed);

  /// random.random(): [0, 1) with 53 bits.
  double uniform();
  /// random.randint(0, last) of Python 2, for which TUM's tools were written (Python 3 draws others).
  std::size_t index_up_to(std::size_t last);

 private:
  std::uint32_t next();

  std::array<std::uint32_t, 624> state_{};
  std::size_t position_ = 624;
};

}  // namespace sediment::tools
