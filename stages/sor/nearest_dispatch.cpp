#include <array>

#include "stages/sor/nearest_kernel.hpp"

namespace sediment::sor {

extern const NearestKernel kPlain;
#if defined(__x86_64__)
extern const NearestKernel kAvx2, kAvx512;
#endif

std::span<const NearestKernel* const> available_kernels() {
#if defined(__x86_64__)
  static constexpr std::array<const NearestKernel*, 3> kAll{&kPlain, &kAvx2, &kAvx512};
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("popcnt")) return std::span(kAll).first(1);
  return std::span(kAll).first(__builtin_cpu_supports("avx512f") ? 3 : 2);
#else
  static constexpr std::array<const NearestKernel*, 1> kAll{&kPlain};
  return kAll;
#endif
}

}  // namespace sediment::sor
