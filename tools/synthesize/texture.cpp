#include "tools/synthesize/texture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sediment::synthetic {
namespace {

std::uint32_t byte_of(float value) {
  return static_cast<std::uint32_t>(std::clamp(value * 255.f + 0.5f, 0.f, 255.f));
}

int texels_along(double length_m, const Sheet& sheet) {
  const int texels = std::max(1, static_cast<int>(std::lround(length_m / sheet.texel_m)));
  return sheet.repeat ? static_cast<int>(std::bit_ceil(static_cast<unsigned>(texels))) : texels;
}

}  // namespace

const Texture::Pyramid& Texture::baked() const {
  std::call_once(pyramid_->baked, [&] { bake(*pyramid_); });
  return *pyramid_;
}

// On one thread: one that waits for others inside call_once could be given work that waits for this texture.
void Texture::bake(Pyramid& pyramid) {
  const Sheet& sheet = pyramid.sheet;
  Level base{texels_along(sheet.width_m, sheet), texels_along(sheet.height_m, sheet), {}};
  const float per_m_u = static_cast<float>(base.width / sheet.width_m);
  const float per_m_v = static_cast<float>(base.height / sheet.height_m);
  base.texels.reserve(static_cast<std::size_t>(base.width) * base.height);
  for (int row = 0; row < base.height; ++row)
    for (int column = 0; column < base.width; ++column) {
      const Rgb c = sheet.pattern((column + 0.5) / per_m_u, (row + 0.5) / per_m_v, sheet.texel_m);
      base.texels.push_back(byte_of(c.r) | byte_of(c.g) << 8 | byte_of(c.b) << 16);
    }
  pyramid.texels_per_m_u = per_m_u, pyramid.texels_per_m_v = per_m_v;
  auto& levels = pyramid.levels;
  levels.push_back(std::move(base));
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back()));
}

/// Means of 2 x 2 texels; an odd row or column at the end is left out.
Texture::Level Texture::halved(const Level& fine) {
  Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  coarse.texels.reserve(static_cast<std::size_t>(coarse.width) * coarse.height);
  constexpr std::uint32_t kOuter = 0x00ff00ff;  // red and blue together, as two numbers of 16 bits
  for (int row = 0; row < coarse.height; ++row) {
    const std::size_t width = static_cast<std::size_t>(fine.width);
    const std::uint32_t* top =
        fine.texels.data() + width * static_cast<std::size_t>(std::min(2 * row, fine.height - 1));
    const std::uint32_t* bottom = 2 * row + 1 < fine.height ? top + width : top;
    for (int column = 0; column < coarse.width; ++column) {
      const int left = std::min(2 * column, fine.width - 1), right = std::min(left + 1, fine.width - 1);
      const std::uint32_t four[] = {top[left], top[right], bottom[left], bottom[right]};
      std::uint32_t outer = 0x00020002, green = 2;
      for (const std::uint32_t texel : four) outer += texel & kOuter, green += texel >> 8 & 0xff;
      coarse.texels.push_back((outer >> 2 & kOuter) | green >> 2 << 8);
    }
  }
  return coarse;
}

}  // namespace sediment::synthetic
