#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace sediment::synthetic {

/// A colour as displayed (not linear light), 0 .. 1 a channel.
struct Rgb {
  float r = 0, g = 0, b = 0;

  friend Rgb operator+(Rgb a, Rgb c) { return {a.r + c.r, a.g + c.g, a.b + c.b}; }
  friend Rgb operator*(float s, Rgb a) { return {s * a.r, s * a.g, s * a.b}; }
  friend Rgb operator*(Rgb a, Rgb c) { return {a.r * c.r, a.g * c.g, a.b * c.b}; }
};

inline Rgb blend(Rgb from, Rgb to, double fraction) {
  const float f = static_cast<float>(fraction);
  return (1 - f) * from + f * to;
}

/// What is painted on a surface: the colour at a place in metres from the surface's corner (u right, v down
/// as one looks at it). Details finer than `texel_m` must be left out.
using Pattern = std::function<Rgb(double u_m, double v_m, double texel_m)>;

/// How far a pixel reaches on a surface: change of (u, v) in metres per pixel to the right and per pixel
/// down.
struct Footprint {
  float du_dx = 0, dv_dx = 0, du_dy = 0, dv_dy = 0;
};

/// Places on one surface with their footprints, one array a quantity: what handles them is vector code.
struct Places {
  static constexpr std::size_t kMost = 256;
  using Values = std::array<float, kMost>;
  alignas(64) Values u_m, v_m;
  alignas(64) Values du_dx, dv_dx, du_dy, dv_dy;
  int count = 0;
};
/// Colours of up to as many places.
struct Colors {
  alignas(64) Places::Values r, g, b;
};

/// A pattern and the surface that it is for.
struct Sheet {
  Pattern pattern;
  double width_m, height_m;
  double texel_m;
  bool repeat;  ///< beyond its border; else the border continues
};

/// A pattern baked into a pyramid of images, so that a pixel sees the mean of its footprint: no aliasing,
/// which would move features from frame to frame. It is baked when it is first seen, which most of a room's
/// never are.
class Texture {
 public:
  explicit Texture(Sheet sheet) : pyramid_(std::make_unique<Pyramid>(std::move(sheet))) {}

  /// Trilinear, with up to four probes along the footprint's longer axis.
  void sample(const Places& places, Colors& colors) const;
  Rgb sample(float u_m, float v_m, const Footprint& footprint) const;

  /// A texel is r + 256 g + 65536 b.
  struct Level {
    int width, height;
    std::vector<std::uint32_t> texels;
  };

 private:
  struct Pyramid {
    explicit Pyramid(Sheet of) : sheet(std::move(of)) {}
    Sheet sheet;
    std::once_flag baked;
    std::vector<Level> levels;  ///< where the sheet repeats, their sizes are powers of two
    float texels_per_m_u = 0, texels_per_m_v = 0;
  };
  const Pyramid& baked() const;
  static void bake(Pyramid& pyramid);
  static Level halved(const Level& fine);

  std::unique_ptr<Pyramid> pyramid_;
};

}  // namespace sediment::synthetic
