#pragma once

// Before a function: it is compiled for several generations of the processor, and the one at hand is chosen
// at the start. Each lane does the same sums in the same order (contraction to fused multiply-add is off in
// the whole project), so results are equal.
#if defined(__x86_64__)
#define SEDIMENT_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define SEDIMENT_CLONES
#endif
