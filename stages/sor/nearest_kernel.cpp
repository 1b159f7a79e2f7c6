// Compiled several times, with SEDIMENT_SOR_KERNEL naming the set of instructions. Nothing that the linker
// could share with code for older processors may come in: no standard library beyond declarations.
#include "stages/sor/nearest_kernel.hpp"

#include <math.h>
#include <stdint.h>

#include "stages/sor/vectors.hpp"

namespace sediment::sor {
namespace {

constexpr size_t kLanes = 8;

inline Floats squared_distances(const Coordinates& points, size_t i, Floats x, Floats y, Floats z) {
  const Floats dx = load(points.x + i) - x, dy = load(points.y + i) - y, dz = load(points.z + i) - z;
  return dx * dx + dy * dy + dz * dz;
}

inline uint32_t bits_of(float value) {
  return __builtin_bit_cast(uint32_t, value);
}
inline float float_of(uint32_t bits) {
  return __builtin_bit_cast(float, bits);
}

/// How many of the squared distances are at most each of three limits. `padded`: a multiple of 16.
struct Counts {
  size_t of[3];
};
inline Counts count_within(const float* squared, size_t padded, float a, float b, float c) {
#if defined(__AVX512F__)
  const Floats limit_a = all(a), limit_b = all(b), limit_c = all(c);
  Counts counts{};
  for (size_t i = 0; i < padded; i += kWidth) {
    const Floats values = load(squared + i);
    counts.of[0] += static_cast<size_t>(__builtin_popcount(at_most(values, limit_a)));
    counts.of[1] += static_cast<size_t>(__builtin_popcount(at_most(values, limit_b)));
    counts.of[2] += static_cast<size_t>(__builtin_popcount(at_most(values, limit_c)));
  }
  return counts;
#else
  uint32_t within_a = 0, within_b = 0, within_c = 0;
  for (size_t i = 0; i < padded; ++i) {
    within_a += squared[i] <= a ? 1 : 0;
    within_b += squared[i] <= b ? 1 : 0;
    within_c += squared[i] <= c ? 1 : 0;
  }
  return {{within_a, within_b, within_c}};
#endif
}

/// Where the k smallest of some values end: `below` of them are at most `low`, the others equal `high`.
struct Cut {
  float low, high;
  size_t below;
};

/// The three limits to try next between `low` with `below` values and `high` with `within`: on a surface
/// counts grow with the square of the distance, so the one that is looked for is near the straight line, give
/// or take the spread of an order statistic. When that does not converge (many equal values): a quarter each
/// of the bit patterns, which are ordered as the floats are.
struct Limits {
  float of[3];
};
inline Limits limits_between(float low, size_t below, float high, size_t within, size_t k, int step) {
  const uint32_t low_bits = bits_of(low), quarter = (bits_of(high) - low_bits + 3) / 4;
  const Limits quarters{{float_of(low_bits + quarter), float_of(low_bits + (bits_of(high) - low_bits) / 2),
                         float_of(bits_of(high) - quarter)}};
  if (step >= 6) return quarters;
  const float count = static_cast<float>(within - below),
              place = (static_cast<float>(k - below) + 0.5f) / count;
  const float spread = sqrtf(place * (1 - place) / count) + 0.25f / count, width = high - low;
  const Limits guess{{low + width * (place - spread), low + width * place, low + width * (place + spread)}};
  return guess.of[0] > low && guess.of[2] < high   ? guess
         : guess.of[1] > low && guess.of[1] < high ? Limits{{guess.of[1], guess.of[1], guess.of[1]}}
                                                   : quarters;
}

/// Narrows an interval of limits by counting. `count` values are at most `high`. Stops when `slack` more than
/// k are left.
inline Cut cut_after(const float* squared, size_t padded, size_t count, size_t k, float high,
                     size_t slack = 0) {
  if (count <= k + slack) return {high, high, k};
  float low = 0;
  size_t below = count_within(squared, padded, 0, 0, 0).of[0], within = count;
  if (below >= k) return {-1, 0, 0};
  for (int step = 0; bits_of(high) - bits_of(low) > 1; ++step) {
    const Limits limits = limits_between(low, below, high, within, k, step);
    const Counts counts = count_within(squared, padded, limits.of[0], limits.of[1], limits.of[2]);
    for (int i = 0; i < 3; ++i) {
      if (counts.of[i] == k) return {limits.of[i], limits.of[i], k};
      if (counts.of[i] > k) {
        high = limits.of[i];
        within = counts.of[i];
        if (within <= k + slack) return {high, high, k};
        break;
      }
      low = limits.of[i];
      below = counts.of[i];
    }
  }
  return {low, high, below};
}

/// Moves the values that are at most `limit` to the front, in their order; returns how many they are.
inline size_t keep_within(float* squared, size_t padded, float limit) {
  const Floats limits = all(limit);
  size_t count = 0;
  for (size_t i = 0; i < padded; i += kWidth) {
    const Floats values = load(squared + i);
    const uint32_t chosen = at_most(values, limits);
    store_chosen(squared + count, values, chosen);
    count += static_cast<size_t>(__builtin_popcount(chosen));
  }
  return count;
}

inline double sum_of_roots(const float* squared, size_t padded) {
  double lanes[kLanes] = {};
  for (size_t i = 0; i < padded; i += kLanes)
    for (size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += sqrt(static_cast<double>(squared[i + lane]));
  return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

/// Fills up to the next multiple of `step`, which is returned.
inline size_t pad(float* values, size_t count, size_t step, float value) {
  const size_t padded = (count + step - 1) / step * step;
  for (size_t i = count; i < padded; ++i) values[i] = value;
  return padded;
}

Nearest nearest(const Coordinates& points, float x, float y, float z, size_t k, float squared_limit,
                float* scratch) {
  const Floats px = all(x), py = all(y), pz = all(z), limit = all(squared_limit);
  size_t count = 0;
  for (size_t i = 0; i < points.size; i += kWidth) {
    const Floats squared = squared_distances(points, i, px, py, pz);
    const uint32_t chosen = at_most(squared, limit);
    store_chosen(scratch + count, squared, chosen);
    count += static_cast<size_t>(__builtin_popcount(chosen));
  }
  const size_t padded = pad(scratch, count, 16, INFINITY);
  const Cut cut = cut_after(scratch, padded, count, k, squared_limit);
  const size_t kept = keep_within(scratch, padded, cut.low);
  const double ties = static_cast<double>(k - cut.below) * sqrt(static_cast<double>(cut.high));
  return {sum_of_roots(scratch, pad(scratch, kept, kLanes, 0)) + ties, cut.high};
}

float nearest_limit(const Coordinates& points, float x, float y, float z, size_t k, float* scratch) {
  const Floats px = all(x), py = all(y), pz = all(z);
  float high = 0;
  for (size_t i = 0; i < points.size; i += kWidth) {
    const Floats squared = squared_distances(points, i, px, py, pz);
    __builtin_memcpy(scratch + i, &squared, sizeof squared);
  }
  for (size_t i = 0; i < points.size; ++i) high = scratch[i] > high ? scratch[i] : high;
  return cut_after(scratch, pad(scratch, points.size, 16, INFINITY), points.size, k, high, k / 8).high;
}

size_t keep_near(const Coordinates& points, float x, float y, float z, float squared_limit) {
  const Floats px = all(x), py = all(y), pz = all(z), limit = all(squared_limit);
  size_t count = 0;
  for (size_t i = 0; i < points.size; i += kWidth) {
    const uint32_t chosen = at_most(squared_distances(points, i, px, py, pz), limit);
    const Floats cx = load(points.x + i), cy = load(points.y + i), cz = load(points.z + i);
    store_chosen(points.x + count, cx, chosen);
    store_chosen(points.y + count, cy, chosen);
    store_chosen(points.z + count, cz, chosen);
    count += static_cast<size_t>(__builtin_popcount(chosen));
  }
  return count;
}

typedef float EightFloats __attribute__((vector_size(32)));
inline void load_eight(const float* from, EightFloats& to) {
  __builtin_memcpy(&to, from, sizeof to);
}

uint32_t boxes_near(const BoxArrays& boxes, size_t first, const float* box, float squared_limit,
                    float* squared) {
  EightFloats sum = {};
  for (int axis = 0; axis < 3; ++axis) {
    EightFloats min, max;
    load_eight(boxes.min[axis] + first, min);
    load_eight(boxes.max[axis] + first, max);
    const EightFloats above = min - box[3 + axis], below = box[axis] - max, none = {};
    const EightFloats gap = above > below ? above : below, outside = gap > none ? gap : none;
    sum += outside * outside;
  }
  __builtin_memcpy(squared, &sum, sizeof sum);
#if defined(__AVX__)
  const __m256 limit = _mm256_set1_ps(squared_limit);
  return static_cast<uint32_t>(
      _mm256_movemask_ps(_mm256_cmp_ps(reinterpret_cast<__m256>(sum), limit, _CMP_LE_OQ)));
#else
  const Floats limit = all(squared_limit);
  return at_most(load(squared), limit) | at_most(load(squared + kWidth), limit) << kWidth;
#endif
}

}  // namespace

#define SEDIMENT_TEXT_(name) #name
#define SEDIMENT_TEXT(name) SEDIMENT_TEXT_(name)
extern const NearestKernel SEDIMENT_SOR_KERNEL;
const NearestKernel SEDIMENT_SOR_KERNEL{SEDIMENT_TEXT(SEDIMENT_SOR_KERNEL), nearest, nearest_limit, keep_near,
                                        boxes_near};

}  // namespace sediment::sor
