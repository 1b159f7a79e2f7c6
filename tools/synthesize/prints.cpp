// Patterns of flat printed things: laid out once from the seed as rectangles, discs and lines of text, then
// looked up by place.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "tools/synthesize/noise_field.hpp"
#include "tools/synthesize/palette.hpp"
#include "tools/synthesize/patterns.hpp"
#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

enum class Mark { field, disc, text, photo };

struct Item {
  Mark mark;
  double u, v, width, height;  ///< metres; a disc is inscribed
  Rgb color;
  std::uint64_t seed;
};

// Words of dashes: lines of height h, in each line words of random length. What cannot be resolved becomes
// the mean tone by itself, because texels average it.
bool inked(const Item& item, double u, double v) {
  const double line_m = std::max(item.height / std::max(1.0, std::round(item.height / 0.022)), 0.004);
  const double line = std::floor((v - item.v) / line_m), within = (v - item.v) / line_m - line;
  if (within < 0.22 || within > 0.78) return false;
  const std::uint64_t h = hash(item.seed, static_cast<std::uint64_t>(line));
  if (u - item.u > item.width * (0.55 + 0.45 * unit(h))) return false;
  const double letter_m = 0.55 * line_m, letter = std::floor((u - item.u) / letter_m);
  const std::uint64_t glyph =
      hash(item.seed, static_cast<std::uint64_t>(line) + 77, static_cast<std::uint64_t>(letter));
  if (glyph % 6 == 0) return false;  // blank between words
  // A glyph: 3 x 3 cells of ink.
  const int column = std::min(2, static_cast<int>(3.6 * ((u - item.u) / letter_m - letter)));
  const int row = std::clamp(static_cast<int>((within - 0.22) / 0.56 * 3), 0, 2);
  if (3.6 * ((u - item.u) / letter_m - letter) > 3) return false;
  return glyph >> (20 + 3 * row + column) & 1;
}

Rgb photo(const Item& item, const FractalNoise& tones, double u, double v, double texel) {
  const double tone = tones.at(u, v, std::max(2 * texel, 0.006));
  const double hill = item.v + item.height * (0.55 + 0.2 * plane_noise(item.seed + 5, u / 0.1, 0.5));
  const Rgb sky = blend(item.color, {.85f, .9f, .97f}, 0.6), ground = 0.6f * item.color;
  return static_cast<float>(1 + 0.28 * tone) * (v < hill ? sky : ground);
}

Pattern print(Rgb background, std::vector<Item> items) {
  std::vector<FractalNoise> tones;  // of each item
  for (const Item& item : items) tones.emplace_back(item.seed, 0.12, 0.7);
  const auto shared = std::make_shared<const std::vector<Item>>(std::move(items));
  const auto shared_tones = std::make_shared<const std::vector<FractalNoise>>(std::move(tones));
  return [=](double u, double v, double texel) {
    Rgb color = background;
    for (std::size_t i = 0; i < shared->size(); ++i) {
      const Item& item = (*shared)[i];
      const double x = u - item.u, y = v - item.v;
      if (x < 0 || y < 0 || x >= item.width || y >= item.height) continue;
      if (item.mark == Mark::field) color = item.color;
      if (item.mark == Mark::disc && std::hypot(2 * x / item.width - 1, 2 * y / item.height - 1) < 1)
        color = item.color;
      if (item.mark == Mark::text && inked(item, u, v)) color = item.color;
      if (item.mark == Mark::photo) color = photo(item, (*shared_tones)[i], u, v, texel);
    }
    return color;
  };
}

}  // namespace

Pattern poster(std::uint64_t seed, double w, double h) {
  Random random(seed);
  const Rgb paper = pale(random);
  const Rgb accent = pigment(random);
  std::vector<Item> items;
  items.push_back({Mark::field, 0, 0, w, 0.16 * h, accent, 0});
  items.push_back({Mark::text, 0.06 * w, 0.03 * h, 0.88 * w, 0.10 * h, gray(0.97), random.next()});
  const double top = random.uniform(0.2, 0.26) * h;
  items.push_back({Mark::photo, 0.06 * w, top, 0.88 * w, 0.34 * h, pigment(random), random.next()});
  for (int k = random.integer(3, 7); k > 0; --k) {
    const double size = random.uniform(0.06, 0.2) * w;
    items.push_back({random.chance(0.5) ? Mark::disc : Mark::field, random.uniform(0.06, 0.74) * w,
                     top + random.uniform(0, 0.26) * h, size, size, pigment(random), 0});
  }
  const double text_top = top + 0.38 * h;
  items.push_back({Mark::text, 0.06 * w, text_top, 0.4 * w, 0.94 * h - text_top, gray(0.15), random.next()});
  if (random.chance(0.5))
    items.push_back({Mark::text, 0.54 * w, text_top, 0.4 * w, 0.94 * h - text_top, gray(0.2), random.next()});
  else
    items.push_back(
        {Mark::photo, 0.54 * w, text_top, 0.4 * w, 0.94 * h - text_top, pigment(random), random.next()});
  return print(paper, std::move(items));
}

Pattern pin_board(std::uint64_t seed, double w, double h) {
  Random random(seed);
  std::vector<Item> items;
  for (double u = 0.05; u + 0.22 < w; u += random.uniform(0.24, 0.32))
    for (double v = 0.05; v + 0.24 < h; v += random.uniform(0.3, 0.38)) {
      const double pw = random.uniform(0.15, 0.22), ph = random.uniform(0.17, std::min(0.29, h - v - 0.03));
      const double x = u + random.uniform(0, 0.05), y = v + random.uniform(0, 0.03);
      items.push_back({Mark::field, x, y, pw, ph, pale(random), 0});
      items.push_back({random.chance(0.35) ? Mark::photo : Mark::text, x + 0.015, y + 0.02, pw - 0.03,
                       ph - 0.04, random.chance(0.35) ? pigment(random) : gray(0.2), random.next()});
      items.push_back({Mark::disc, x + pw / 2 - 0.008, y + 0.002, 0.016, 0.016, pigment(random), 0});
    }
  const Pattern cork = speckled(seed + 3, {.78f, .58f, .38f}), sheets = print({-1, 0, 0}, std::move(items));
  return [=](double u, double v, double texel) {
    if (std::min(std::min(u, w - u), std::min(v, h - v)) < 0.02) return Rgb{.45f, .33f, .2f};
    const Rgb sheet = sheets(u, v, texel);
    return sheet.r < 0 ? cork(u, v, texel) : sheet;
  };
}

Pattern whiteboard(std::uint64_t seed, double w, double h) {
  Random random(seed);
  const Rgb pens[] = {{.12f, .20f, .55f}, {.65f, .12f, .12f}, {.08f, .42f, .22f}, {.1f, .1f, .12f}};
  std::vector<Item> items;
  for (double u = 0.06; u + 0.3 < w; u += 0.36)
    for (double v = 0.06; v + 0.2 < h; v += 0.3) {
      const Rgb pen = pens[random.integer(0, 3)];
      const double x = u + random.uniform(0, 0.05), y = v + random.uniform(0, 0.05);
      if (random.chance(0.45)) {  // a box of a diagram, with its inside left white
        items.push_back({Mark::field, x, y, 0.22, 0.13, pen, 0});
        items.push_back({Mark::field, x + 0.008, y + 0.008, 0.204, 0.114, gray(0.93), 0});
        items.push_back({Mark::field, x + 0.22, y + 0.06, 0.13, 0.008, pen, 0});
        items.push_back({Mark::text, x + 0.03, y + 0.03, 0.16, 0.07, pen, random.next()});
      } else {
        items.push_back({Mark::text, x, y, 0.28, random.uniform(0.1, 0.22), pen, random.next()});
      }
    }
  const Pattern wiped = grain(seed + 1, 0.02);
  const Pattern writing = print(gray(0.93), std::move(items));
  return
      [=](double u, double v, double texel) { return wiped(u, v, texel) * (1.07f * writing(u, v, texel)); };
}

Pattern clock_face() {
  return [](double u, double v, double texel) {
    const double x = u - 0.14, y = 0.14 - v, radius = std::sqrt(x * x + y * y), angle = std::atan2(x, y);
    const auto hand = [&](double turn, double length, double width) {
      const double along = x * std::sin(turn) + y * std::cos(turn),
                   across = x * std::cos(turn) - y * std::sin(turn);
      return along > -0.01 && along < length && std::abs(across) < std::max(width, texel) / 2;
    };
    const double hours = angle / (2 * std::numbers::pi / 12);
    const bool mark = radius > 0.105 && radius < 0.125 && std::abs(hours - std::round(hours)) < 0.1;
    return gray(hand(5.3, 0.07, 0.010) || hand(0.9, 0.10, 0.007) || mark || radius > 0.132 ? 0.1 : 0.94);
  };
}

Pattern screen(std::uint64_t seed, double w, double h) {
  Random random(seed);
  std::vector<Item> items;
  items.push_back({Mark::photo, 0, 0, w, h, pigment(random), random.next()});
  for (int window = 0; window < 3; ++window) {
    const double ww = random.uniform(0.4, 0.6) * w, wh = random.uniform(0.5, 0.75) * h;
    const double u = random.uniform(0.01, 0.99 - ww / w) * w, v = random.uniform(0.02, 0.9 - wh / h) * h;
    const bool dark = random.chance(0.5);
    items.push_back({Mark::field, u, v, ww, wh, gray(dark ? 0.12 : 0.93), 0});
    items.push_back({Mark::field, u, v, ww, 0.018, pigment(random), 0});
    items.push_back({Mark::text, u + 0.008, v + 0.028, ww - 0.02, wh - 0.04, dark ? pale(random) : gray(0.12),
                     random.next()});
  }
  items.push_back({Mark::field, 0, h - 0.018, w, 0.018, gray(0.2), 0});
  return print(gray(0.3), std::move(items));
}

Pattern keyboard(std::uint64_t seed, double w, double h) {
  return [=](double u, double v, double) {
    const double pitch = 0.019, x = (u - 0.008) / pitch, y = (v - 0.012) / pitch;
    const double column = std::floor(x), row = std::floor(y);
    if (u < 0.008 || u > w - 0.012 || v < 0.012 || v > h - 0.012) return gray(0.13);
    const double dx = x - column, dy = y - row;
    if (dx < 0.1 || dx > 0.9 || dy < 0.1 || dy > 0.9) return gray(0.08);
    const std::uint64_t key = hash(seed, static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row));
    if (dx > 0.25 && dx < 0.6 && dy > 0.25 && dy < 0.65 && key % 5 != 0) return gray(0.75);
    return key % 7 == 0 ? gray(0.42) : gray(0.24);
  };
}

Pattern book_spine(std::uint64_t seed, double w, double h) {
  Random random(seed);
  const Rgb cover = pigment(random), accent = pigment(random);
  std::vector<Item> items;
  const double band = random.uniform(0.05, 0.2) * h;
  items.push_back({Mark::field, 0, band, w, random.uniform(0.03, 0.12) * h, accent, 0});
  if (random.chance(0.6)) items.push_back({Mark::field, 0, 0.86 * h, w, 0.05 * h, accent, 0});
  items.push_back({Mark::text, 0.2 * w, 0.36 * h, 0.6 * w, 0.4 * h,
                   random.chance(0.6) ? gray(0.95) : gray(0.1), random.next()});
  return print(cover, std::move(items));
}

Pattern cardboard(std::uint64_t seed, double w, double h) {
  Random random(seed);
  std::vector<Item> items;
  items.push_back({Mark::field, 0.46 * w, 0, 0.08 * w, h, {.72f, .62f, .42f}, 0});
  items.push_back({Mark::field, 0.08 * w, 0.2 * h, 0.32 * w, 0.4 * h, gray(0.92), 0});
  items.push_back({Mark::text, 0.1 * w, 0.24 * h, 0.28 * w, 0.32 * h, gray(0.1), random.next()});
  items.push_back({Mark::disc, 0.66 * w, 0.5 * h, 0.2 * w, 0.2 * w, pigment(random), 0});
  items.push_back({Mark::text, 0.6 * w, 0.12 * h, 0.33 * w, 0.25 * h, {.3f, .2f, .12f}, random.next()});
  const Pattern paper = grain(seed + 1, 0.07), printed = print({1, 1, 1}, std::move(items));
  return [=](double u, double v, double texel) {
    const Rgb ink = printed(u, v, texel);
    const Rgb board = paper(u, v, texel) * Rgb{.72f, .55f, .37f};
    return ink.r == 1 && ink.g == 1 ? board : paper(u, v, texel) * ink;
  };
}

}  // namespace sediment::synthetic
