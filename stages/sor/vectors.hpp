#pragma once

// Vectors of the set of instructions that the including file is compiled for. Everything is in an unnamed
// namespace: the linker must not share it between files that are compiled for different processors.
#include <stddef.h>
#include <stdint.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace sediment::sor {
namespace {

// Each: the width, a load of that many floats, a mask of the lanes where a <= b, and a store of the chosen
// lanes side by side, which may write a whole vector.
#if defined(__AVX512F__)

constexpr size_t kWidth = 16;
using Floats = __m512;
inline Floats load(const float* from) {
  return _mm512_loadu_ps(from);
}
inline Floats all(float value) {
  return _mm512_set1_ps(value);
}
inline uint32_t at_most(Floats a, Floats b) {
  return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
}
/// Compressed in a register: compressing stores are slow on some processors.
inline void store_chosen(float* to, Floats values, uint32_t chosen) {
  _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(chosen), values));
}

#elif defined(__AVX2__)

constexpr size_t kWidth = 8;
using Floats = __m256;
inline Floats load(const float* from) {
  return _mm256_loadu_ps(from);
}
inline Floats all(float value) {
  return _mm256_set1_ps(value);
}
inline uint32_t at_most(Floats a, Floats b) {
  return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
}

/// For each mask of eight bits the indices of its ones, in order.
struct Orders {
  alignas(32) int32_t of[256][8] = {};
  constexpr Orders() {
    for (int mask = 0; mask < 256; ++mask)
      for (int bit = 0, place = 0; bit < 8; ++bit)
        if (mask >> bit & 1) of[mask][place++] = bit;
  }
};
constexpr Orders kOrders;

inline void store_chosen(float* to, Floats values, uint32_t chosen) {
  const __m256i order = _mm256_load_si256(reinterpret_cast<const __m256i*>(kOrders.of[chosen]));
  _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(values, order));
}

#else

constexpr size_t kWidth = 4;
typedef float Floats __attribute__((vector_size(16)));
inline Floats load(const float* from) {
  return Floats{from[0], from[1], from[2], from[3]};
}
inline Floats all(float value) {
  return Floats{value, value, value, value};
}
inline uint32_t at_most(Floats a, Floats b) {
#if defined(__SSE2__)
  return static_cast<uint32_t>(_mm_movemask_ps(_mm_cmple_ps(a, b)));
#else
  uint32_t mask = 0;
  for (uint32_t i = 0; i < kWidth; ++i) mask |= (a[i] <= b[i] ? 1u : 0u) << i;
  return mask;
#endif
}
inline void store_chosen(float* to, Floats values, uint32_t chosen) {
  for (; chosen != 0; chosen &= chosen - 1) *to++ = values[__builtin_ctz(chosen)];
}

#endif

}  // namespace
}  // namespace sediment::sor
