// Texture::sample: all places of a batch that take as many probes from the same levels are handled together.
#include <algorithm>
#include <bit>
#include <cmath>

#include "tools/synthesize/texture.hpp"
#include "tools/synthesize/vector_code.hpp"

namespace sediment::synthetic {
namespace {

constexpr std::size_t kMost = Places::kMost;
template <class T>
using Batch = std::array<T, kMost>;
using Texel = std::uint32_t;

// A key says how a place is sampled: number of probes - 1 (2 bits), whether two levels are blended, finer
// level.
constexpr int kBlended = 4, kLevel = 8, kKeys = 32 * kLevel;

struct Plan {
  alignas(64) Batch<float> u, v;            ///< in texels of the finest level
  alignas(64) Batch<float> step_u, step_v;  ///< from probe to probe
  alignas(64) Batch<float> fraction;        ///< of the coarser level
  alignas(64) Batch<int> key;
};

SEDIMENT_CLONES void plan_probes(const Places& places, float per_m_u, float per_m_v, int levels, Plan& plan) {
  for (int i = 0; i < places.count; ++i) {
    const float ax = places.du_dx[i] * per_m_u, ay = places.dv_dx[i] * per_m_v;
    const float bx = places.du_dy[i] * per_m_u, by = places.dv_dy[i] * per_m_v;
    const float a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
    const float major2 = greater(a2, b2), minor2 = greater(lesser(a2, b2), 1.f);
    // As many probes as the longer axis is longer, up to four.
    const int two = major2 >= 4 * minor2, three = major2 >= 9 * minor2, four = major2 >= 16 * minor2;
    const float share = four ? 1 / 4.f : three ? 1 / 3.f : two ? 1 / 2.f : 1.f;
    const float width = greater(std::sqrt(major2) * share, 1.f);  // of a probe, in texels
    // Between the level whose texels are at most as wide and the next; near either of them that level alone.
    const int exponent = (std::bit_cast<std::int32_t>(width) >> 23) - 127;
    const int fine = exponent < levels - 1 ? exponent : levels - 1;
    const float scale = std::bit_cast<float>((127 - fine) << 23);  // of 2 to the power of -fine
    const float fraction = lesser(greater(2 * (width * scale - 1.25f), 0.f), 1.f);
    const int blended = (fraction > 0.02f) & (fine + 1 < levels);
    plan.u[i] = places.u_m[i] * per_m_u, plan.v[i] = places.v_m[i] * per_m_v;
    plan.step_u[i] = (a2 > b2 ? ax : bx) * share, plan.step_v[i] = (a2 > b2 ? ay : by) * share;
    plan.fraction[i] = fraction;
    plan.key[i] = two + three + four + kBlended * blended + kLevel * fine;
  }
}

/// The four texels around each place of a level, and its distances to the upper left one in 1/256.
struct Corners {
  alignas(64) Batch<std::int32_t> upper_left, upper_right, lower_left, lower_right;  ///< indices
  alignas(64) Batch<std::uint32_t> right, down;
};

SEDIMENT_INLINE void find_corners(const Texture::Level& level, bool repeat, const Batch<float>& us,
                                  const Batch<float>& vs, int count, Corners& corners) {
  const int last_column = level.width - 1, last_row = level.height - 1, width = level.width;
  for (int i = 0; i < count; ++i) {
    const float u = us[i] - 0.5f, v = vs[i] - 0.5f;  // centres of texels are at half integers
    const int column = floor_of(u), row = floor_of(v);
    corners.right[i] = static_cast<std::uint32_t>(static_cast<int>((u - static_cast<float>(column)) * 256));
    corners.down[i] = static_cast<std::uint32_t>(static_cast<int>((v - static_cast<float>(row)) * 256));
    // Either wrapped (sizes are powers of two) or held at the border.
    const int left = repeat ? column & last_column : bounded(column, last_column);
    const int right = repeat ? (column + 1) & last_column : bounded(column + 1, last_column);
    const int top = width * (repeat ? row & last_row : bounded(row, last_row));
    const int bottom = width * (repeat ? (row + 1) & last_row : bounded(row + 1, last_row));
    corners.upper_left[i] = top + left, corners.upper_right[i] = top + right;
    corners.lower_left[i] = bottom + left, corners.lower_right[i] = bottom + right;
  }
}

/// Red and blue of a texel are mixed as two numbers of 16 bits in one.
constexpr std::uint32_t kOuter = 0x00ff00ff;

SEDIMENT_INLINE std::uint32_t mixed_column(std::uint32_t high, std::uint32_t low, std::uint32_t down) {
  return ((high * (256 - down) + low * down + 0x00800080) >> 8) & kOuter;
}

/// Channels of each place, 0 .. 255 * 256.
SEDIMENT_INLINE void bilinear(const Texture::Level& level, bool repeat, const Batch<float>& u,
                              const Batch<float>& v, int count, Colors& colors) {
  Corners at;
  find_corners(level, repeat, u, v, count, at);
  alignas(64) Batch<Texel> upper_left, upper_right, lower_left, lower_right;
  const Texel* texels = level.texels.data();
  for (int i = 0; i < count; ++i) {
    upper_left[i] = texels[at.upper_left[i]], upper_right[i] = texels[at.upper_right[i]];
    lower_left[i] = texels[at.lower_left[i]], lower_right[i] = texels[at.lower_right[i]];
  }
  for (int i = 0; i < count; ++i) {
    const std::uint32_t right = at.right[i], down = at.down[i];
    const std::uint32_t outer =
        mixed_column(upper_left[i] & kOuter, lower_left[i] & kOuter, down) * (256 - right) +
        mixed_column(upper_right[i] & kOuter, lower_right[i] & kOuter, down) * right;
    const std::uint32_t green =
        mixed_column(upper_left[i] >> 8 & 0xff, lower_left[i] >> 8 & 0xff, down) * (256 - right) +
        mixed_column(upper_right[i] >> 8 & 0xff, lower_right[i] >> 8 & 0xff, down) * right;
    colors.r[i] = static_cast<float>(static_cast<int>(outer & 0xffff));
    colors.g[i] = static_cast<float>(static_cast<int>(green & 0xffff));
    colors.b[i] = static_cast<float>(static_cast<int>(outer >> 16));
  }
}

// All places of a plan, which have the same key.
SEDIMENT_CLONES void sample_group(const std::vector<Texture::Level>& levels, bool repeat, const Plan& plan,
                                  int places, int key, Colors& sum) {
  const int count = whole_vectors(places);
  const int probes = 1 + key % kBlended, fine = key / kLevel;
  const bool blended = (key & kBlended) != 0;
  const float scale = 1.f / static_cast<float>(1u << fine);
  static constexpr float kShare[] = {0, 1, 1 / 2.f, 1 / 3.f, 1 / 4.f};
  for (int i = 0; i < count; ++i) sum.r[i] = sum.g[i] = sum.b[i] = 0;
  for (int probe = 0; probe < probes; ++probe) {
    const float offset = static_cast<float>(probe) - 0.5f * static_cast<float>(probes - 1);
    alignas(64) Batch<float> u, v;
    for (int i = 0; i < count; ++i) {
      u[i] = (plan.u[i] + offset * plan.step_u[i]) * scale;
      v[i] = (plan.v[i] + offset * plan.step_v[i]) * scale;
    }
    Colors near, far;
    bilinear(levels[static_cast<std::size_t>(fine)], repeat, u, v, count, near);
    if (blended) {
      for (int i = 0; i < count; ++i) u[i] *= 0.5f, v[i] *= 0.5f;
      bilinear(levels[static_cast<std::size_t>(fine) + 1], repeat, u, v, count, far);
      for (int i = 0; i < count; ++i) {
        near.r[i] += plan.fraction[i] * (far.r[i] - near.r[i]);
        near.g[i] += plan.fraction[i] * (far.g[i] - near.g[i]);
        near.b[i] += plan.fraction[i] * (far.b[i] - near.b[i]);
      }
    }
    for (int i = 0; i < count; ++i) sum.r[i] += near.r[i], sum.g[i] += near.g[i], sum.b[i] += near.b[i];
  }
  const float norm = kShare[probes] / (255.f * 256.f);
  for (int i = 0; i < count; ++i) sum.r[i] *= norm, sum.g[i] *= norm, sum.b[i] *= norm;
}

/// Moves some places of a plan to the front of another, and fills its last vector up.
void pick(const Plan& plan, const std::uint8_t* indices, int count, Plan& picked) {
  for (int i = 0; i < whole_vectors(count); ++i) {
    const std::size_t from = indices[std::min(i, count - 1)];
    picked.u[i] = plan.u[from], picked.v[i] = plan.v[from];
    picked.step_u[i] = plan.step_u[from], picked.step_v[i] = plan.step_v[from];
    picked.fraction[i] = plan.fraction[from];
  }
}

}  // namespace

void Texture::sample(const Places& places, Colors& colors) const {
  Plan plan, picked;
  const Pyramid& pyramid = baked();
  plan_probes(places, pyramid.texels_per_m_u, pyramid.texels_per_m_v, static_cast<int>(pyramid.levels.size()),
              plan);
  // Sorted by key: where each key's places begin, then their indices.
  std::array<int, kKeys + 1> begin{};
  for (int i = 0; i < places.count; ++i) ++begin[static_cast<std::size_t>(plan.key[i]) + 1];
  for (std::size_t key = 1; key <= kKeys; ++key) begin[key] += begin[key - 1];
  std::array<int, kKeys + 1> end = begin;
  Batch<std::uint8_t> order;
  for (int i = 0; i < places.count; ++i)
    order[static_cast<std::size_t>(end[static_cast<std::size_t>(plan.key[i])]++)] =
        static_cast<std::uint8_t>(i);
  Colors sampled;
  for (int first = 0; first < places.count;) {
    const int key = plan.key[order[static_cast<std::size_t>(first)]];
    const std::uint8_t* indices = order.data() + first;
    const int count = end[static_cast<std::size_t>(key)] - first;
    pick(plan, indices, count, picked);
    sample_group(pyramid.levels, pyramid.sheet.repeat, picked, count, key, sampled);
    for (int i = 0; i < count; ++i) {
      const std::size_t to = indices[i];
      colors.r[to] = sampled.r[i], colors.g[to] = sampled.g[i], colors.b[to] = sampled.b[i];
    }
    first += count;
  }
}

Rgb Texture::sample(float u_m, float v_m, const Footprint& f) const {
  Places one;
  one.u_m[0] = u_m, one.v_m[0] = v_m;
  one.du_dx[0] = f.du_dx, one.dv_dx[0] = f.dv_dx, one.du_dy[0] = f.du_dy, one.dv_dy[0] = f.dv_dy;
  one.count = 1;
  Colors color;
  sample(one, color);
  return {color.r[0], color.g[0], color.b[0]};
}

}  // namespace sediment::synthetic
