#include "tools/synthesize/texture.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace sediment::synthetic {
namespace {

using Float4 = float __attribute__((vector_size(16)));
using Byte8 = std::uint8_t __attribute__((vector_size(8)));
using Word8 = std::uint16_t __attribute__((vector_size(16)));
using Long2 = std::uint64_t __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));
using Texel = std::array<std::uint8_t, 4>;

/// Two texels, eight channels.
[[gnu::always_inline]] inline Word8 pair_of(const Texel& left, const Texel& right) {
  Byte8 bytes;
  std::memcpy(&bytes, left.data(), 4);
  std::memcpy(reinterpret_cast<char*>(&bytes) + 4, right.data(), 4);
  return __builtin_convertvector(bytes, Word8);
}

[[gnu::always_inline]] inline int floor_of(float x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero - (x < static_cast<float>(towards_zero));
}

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::clamp(value * 255.f + 0.5f, 0.f, 255.f));
}

int texels_along(double length_m, const Sheet& sheet) {
  const int texels = std::max(1, static_cast<int>(std::lround(length_m / sheet.texel_m)));
  return sheet.repeat ? static_cast<int>(std::bit_ceil(static_cast<unsigned>(texels))) : texels;
}

/// Four channels, 0 .. 255 * 256, with weights of 1/256. `u`, `v` in texels of the level, whose centres are
/// at half integers.
template <class Level>
[[gnu::always_inline]] inline Float4 bilinear(const Level& level, bool repeat, float u, float v) {
  u -= 0.5f, v -= 0.5f;
  int left = floor_of(u), top = floor_of(v);
  const int fu = static_cast<int>((u - static_cast<float>(left)) * 256),
            fv = static_cast<int>((v - static_cast<float>(top)) * 256);
  int right = left + 1, bottom = top + 1;
  const int last_column = level.width - 1, last_row = level.height - 1;
  if (repeat) {
    left &= last_column, right &= last_column, top &= last_row, bottom &= last_row;
  } else {
    left = std::clamp(left, 0, last_column), right = std::clamp(right, 0, last_column);
    top = std::clamp(top, 0, last_row), bottom = std::clamp(bottom, 0, last_row);
  }
  const Word8 high = pair_of(level.at(top, left), level.at(top, right));
  const Word8 low = pair_of(level.at(bottom, left), level.at(bottom, right));
  const auto r = static_cast<std::uint16_t>(fu), l = static_cast<std::uint16_t>(256 - fu);
  const auto up = static_cast<std::uint16_t>(256 - fv), down = static_cast<std::uint16_t>(fv);
  const Word8 column = (high * up + low * down + std::uint16_t{128}) >> 8;
  const std::uint64_t left_weight = l * 0x0001000100010001u, right_weight = r * 0x0001000100010001u;
  const Word8 weights = reinterpret_cast<Word8>(Long2{left_weight, right_weight});
  Word8 mixed = column * weights;
  mixed += __builtin_shuffle(mixed, Word8{4, 5, 6, 7, 0, 1, 2, 3});
  // The lower four words widened.
  return __builtin_convertvector(
      reinterpret_cast<Int4>(__builtin_shuffle(mixed, Word8{}, Word8{0, 8, 1, 8, 2, 8, 3, 8})), Float4);
}

}  // namespace

Texture::Texture(const Sheet& sheet) : repeat_(sheet.repeat) {
  Level base{texels_along(sheet.width_m, sheet), texels_along(sheet.height_m, sheet), {}};
  texels_per_m_u_ = static_cast<float>(base.width / sheet.width_m);
  texels_per_m_v_ = static_cast<float>(base.height / sheet.height_m);
  base.texels.resize(static_cast<std::size_t>(base.width) * base.height);
  tbb::parallel_for(0, base.height, [&](int row) {
    for (int column = 0; column < base.width; ++column) {
      const Rgb c =
          sheet.pattern((column + 0.5) / texels_per_m_u_, (row + 0.5) / texels_per_m_v_, sheet.texel_m);
      base.texels[static_cast<std::size_t>(row) * base.width + column] = {byte_of(c.r), byte_of(c.g),
                                                                          byte_of(c.b), 0};
    }
  });
  levels_.push_back(std::move(base));
  while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved(levels_.back()));
}

/// Means of 2 x 2 texels; an odd row or column at the end is left out.
Texture::Level Texture::halved(const Level& fine) {
  Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  coarse.texels.reserve(static_cast<std::size_t>(coarse.width) * coarse.height);
  for (int row = 0; row < coarse.height; ++row)
    for (int column = 0; column < coarse.width; ++column) {
      const int left = std::min(2 * column, fine.width - 1), right = std::min(left + 1, fine.width - 1);
      const int top = std::min(2 * row, fine.height - 1), bottom = std::min(top + 1, fine.height - 1);
      Texel mean{};
      for (std::size_t c = 0; c < 3; ++c)
        mean[c] = static_cast<std::uint8_t>((fine.at(top, left)[c] + fine.at(top, right)[c] +
                                             fine.at(bottom, left)[c] + fine.at(bottom, right)[c] + 2) /
                                            4);
      coarse.texels.push_back(mean);
    }
  return coarse;
}

[[gnu::target_clones("avx2", "default")]] Rgb Texture::sample(float u_m, float v_m,
                                                              const Footprint& footprint) const {
  const float ax = footprint.du_dx * texels_per_m_u_, ay = footprint.dv_dx * texels_per_m_v_;
  const float bx = footprint.du_dy * texels_per_m_u_, by = footprint.dv_dy * texels_per_m_v_;
  const float a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
  const float major2 = std::max(a2, b2), minor2 = std::max(std::min(a2, b2), 1.f);
  // As many probes as the longer axis is longer, up to four.
  const int probes = 1 + (major2 >= 4 * minor2) + (major2 >= 9 * minor2) + (major2 >= 16 * minor2);
  static constexpr float kShare[] = {0, 1, 1 / 2.f, 1 / 3.f, 1 / 4.f};
  const float share = kShare[probes],
              width = std::max(std::sqrt(major2) * share, 1.f);  // of a probe, in texels
  // Between the level whose texels are at most as wide and the next; near either of them that level alone.
  const int fine = std::min(static_cast<int>(std::bit_width(static_cast<unsigned>(width))) - 1,
                            static_cast<int>(levels_.size()) - 1);
  const float scale = 1.f / static_cast<float>(1u << fine),
              fraction = std::clamp(2 * (width * scale - 1.25f), 0.f, 1.f);
  const bool blended = fraction > 0.02f && fine + 1 < static_cast<int>(levels_.size());
  const float step_u = (a2 > b2 ? ax : bx) * share, step_v = (a2 > b2 ? ay : by) * share;
  Float4 sum{};
  for (int probe = 0; probe < probes; ++probe) {
    const float offset = static_cast<float>(probe) - 0.5f * static_cast<float>(probes - 1);
    const float u = (u_m * texels_per_m_u_ + offset * step_u) * scale,
                v = (v_m * texels_per_m_v_ + offset * step_v) * scale;
    Float4 color = bilinear(levels_[static_cast<std::size_t>(fine)], repeat_, u, v);
    if (blended)
      color +=
          fraction * (bilinear(levels_[static_cast<std::size_t>(fine) + 1], repeat_, u / 2, v / 2) - color);
    sum += color;
  }
  sum *= share / (255.f * 256.f);
  return {sum[0], sum[1], sum[2]};
}

}  // namespace sediment::synthetic
