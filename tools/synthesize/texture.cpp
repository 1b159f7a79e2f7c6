#include "tools/synthesize/texture.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sediment::synthetic {
namespace {

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::clamp(value * 255.f + 0.5f, 0.f, 255.f));
}

}  // namespace

Texture::Texture(const Pattern& pattern, double width_m, double height_m, double texel_m, bool repeat)
    : repeat_(repeat) {
  Level base{std::max(1, static_cast<int>(std::lround(width_m / texel_m))),
             std::max(1, static_cast<int>(std::lround(height_m / texel_m))),
             {}};
  texels_per_m_u_ = static_cast<float>(base.width / width_m);
  texels_per_m_v_ = static_cast<float>(base.height / height_m);
  base.texels.resize(static_cast<std::size_t>(base.width) * base.height);
  tbb::parallel_for(0, base.height, [&](int row) {
    for (int column = 0; column < base.width; ++column) {
      const Rgb c = pattern((column + 0.5) / texels_per_m_u_, (row + 0.5) / texels_per_m_v_, texel_m);
      base.texels[static_cast<std::size_t>(row) * base.width + column] = {byte_of(c.r), byte_of(c.g),
                                                                          byte_of(c.b), 0};
    }
  });
  levels_.push_back(std::move(base));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    coarse.texels.resize(static_cast<std::size_t>(coarse.width) * coarse.height);
    for (int row = 0; row < coarse.height; ++row)
      for (int column = 0; column < coarse.width; ++column) {
        // An odd row or column at the end is left out: half a coarse texel at most.
        const int left = std::min(2 * column, fine.width - 1), right = std::min(left + 1, fine.width - 1);
        const int top = std::min(2 * row, fine.height - 1), bottom = std::min(top + 1, fine.height - 1);
        for (int channel = 0; channel < 3; ++channel) {
          const auto at = [&](int y, int x) {
            return int{fine.texels[static_cast<std::size_t>(y) * fine.width + x][channel]};
          };
          coarse.texels[static_cast<std::size_t>(row) * coarse.width + column][channel] =
              static_cast<std::uint8_t>(
                  (at(top, left) + at(top, right) + at(bottom, left) + at(bottom, right) + 2) / 4);
        }
      }
    levels_.push_back(std::move(coarse));
  }
}

Rgb Texture::bilinear(const Level& level, float u, float v) const {
  u -= 0.5f;
  v -= 0.5f;
  const float column = std::floor(u), row = std::floor(v);
  const float fu = u - column, fv = v - row;
  int left = static_cast<int>(column), top = static_cast<int>(row), right = left + 1, bottom = top + 1;
  if (repeat_) {
    const auto wrap = [](int x, int n) { return (x %= n) < 0 ? x + n : x; };
    left = wrap(left, level.width), right = wrap(right, level.width);
    top = wrap(top, level.height), bottom = wrap(bottom, level.height);
  } else {
    left = std::clamp(left, 0, level.width - 1), right = std::clamp(right, 0, level.width - 1);
    top = std::clamp(top, 0, level.height - 1), bottom = std::clamp(bottom, 0, level.height - 1);
  }
  const auto* upper = &level.texels[static_cast<std::size_t>(top) * level.width];
  const auto* lower = &level.texels[static_cast<std::size_t>(bottom) * level.width];
  const auto mixed = [&](int c) {
    const float high = upper[left][c] + fu * (upper[right][c] - upper[left][c]);
    const float low = lower[left][c] + fu * (lower[right][c] - lower[left][c]);
    return (high + fv * (low - high)) * (1 / 255.f);
  };
  return {mixed(0), mixed(1), mixed(2)};
}

Rgb Texture::sample(float u_m, float v_m, const Footprint& footprint) const {
  const float ax = footprint.du_dx * texels_per_m_u_, ay = footprint.dv_dx * texels_per_m_v_;
  const float bx = footprint.du_dy * texels_per_m_u_, by = footprint.dv_dy * texels_per_m_v_;
  const float a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
  const float major = std::sqrt(std::max(a2, b2)), minor = std::sqrt(std::min(a2, b2));
  const int probes = std::clamp(static_cast<int>(major / std::max(minor, 1.f)), 1, 4);
  const float level = std::clamp(std::log2(std::max(major / probes, 1.f)), 0.f, levels_.size() - 1.001f);
  const int fine = static_cast<int>(level);
  const float fraction = level - static_cast<float>(fine);
  const float step_u = (a2 > b2 ? ax : bx) / probes, step_v = (a2 > b2 ? ay : by) / probes;
  Rgb sum;
  for (int probe = 0; probe < probes; ++probe) {
    const float offset = static_cast<float>(probe) - 0.5f * static_cast<float>(probes - 1);
    const float u = u_m * texels_per_m_u_ + offset * step_u, v = v_m * texels_per_m_v_ + offset * step_v;
    const float scale = 1.f / static_cast<float>(1 << fine);
    const Rgb sharp = bilinear(levels_[fine], u * scale, v * scale);
    const bool blended = fraction > 0.02f && fine + 1 < static_cast<int>(levels_.size());
    sum = sum + (blended ? blend(sharp, bilinear(levels_[fine + 1], u * scale / 2, v * scale / 2), fraction)
                         : sharp);
  }
  return (1.f / static_cast<float>(probes)) * sum;
}

std::size_t Texture::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels_) sum += 4 * level.texels.size();
  return sum;
}

}  // namespace sediment::synthetic
