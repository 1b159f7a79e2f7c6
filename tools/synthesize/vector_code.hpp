#pragma once

#include <cstdint>

#include "pipeline/scene/vector_clones.hpp"

// What loops over batches of pixels are written with. They have no branches, so that the compiler makes
// vector code of them, of the width that the processor at hand has (SEDIMENT_CLONES).
#define SEDIMENT_INLINE inline __attribute__((always_inline))

namespace sediment::synthetic {

SEDIMENT_INLINE float lesser(float a, float b) {
  return a < b ? a : b;
}
SEDIMENT_INLINE float greater(float a, float b) {
  return a > b ? a : b;
}
// std::floor is a call into the library on baseline x86-64.
SEDIMENT_INLINE int floor_of(float x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero - (x < static_cast<float>(towards_zero));
}
/// 0 .. last.
SEDIMENT_INLINE int bounded(int x, int last) {
  const int high = x < last ? x : last;
  return high > 0 ? high : 0;
}
/// A count of pixels rounded up to whole vectors of any processor.
SEDIMENT_INLINE int whole_vectors(int count) {
  return (count + 15) & ~15;
}

}  // namespace sediment::synthetic
