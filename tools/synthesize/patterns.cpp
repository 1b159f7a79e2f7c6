#include "tools/synthesize/patterns.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synthesize/noise_field.hpp"
#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

float f(double x) {
  return static_cast<float>(x);
}

// Hash of the cell of a grid.
std::uint64_t cell(std::uint64_t seed, double x, double y) {
  return hash(seed, static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x))),
              static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(y))));
}

}  // namespace

Pattern plaster(std::uint64_t seed, Rgb color, double contrast) {
  const FractalNoise cloudy(seed, 0.6), grainy(seed + 1, 0.08, 0.75);
  return [=](double u, double v, double texel) {
    const double clouds = cloudy.at(u, v, 0.15);
    const double grains = grainy.at(u, v, std::max(2 * texel, 0.006));
    // Marks, chips and scuffs: a few in each cell of 14 cm, round or drawn out, most of them dark.
    double marks = 0;
    for (int k = 0; k < 4; ++k) {
      constexpr double kCell = 0.14;
      const double cu = u / kCell + k * 0.37, cv = v / kCell + k * 0.71;
      const std::uint64_t h = cell(seed + 7 + static_cast<std::uint64_t>(k), cu, cv);
      const double turn = unit(mix(h + 4)), stretch = 0.35 + 1.3 * unit(mix(h + 2));
      const double du = cu - std::floor(cu) - 0.25 - 0.5 * unit(h),
                   dv = cv - std::floor(cv) - 0.25 - 0.5 * unit(mix(h));
      const double along = (du + (turn - 0.5) * dv) / stretch, across = (dv - (turn - 0.5) * du) * stretch;
      const double radius = 0.02 + 0.09 * std::pow(unit(mix(h + 1)), 2);
      const double edge = (radius - std::sqrt(along * along + across * across)) * kCell / (1.5 * texel);
      marks += std::clamp(edge + 0.5, 0.0, 1.0) * (unit(mix(h + 3)) - 0.66);
    }
    return f(1 + contrast * (0.05 * clouds + 0.08 * grains + 0.42 * marks)) * color;
  };
}

Pattern wood(std::uint64_t seed, Rgb color) {
  const FractalNoise bent(seed, 0.5), fibrous(seed + 2, 0.02, 0.8);
  return [=](double u, double v, double texel) {
    const double bend = 0.05 * bent.at(u / 3, v, 0.1);
    const double ring = plane_noise(seed + 1, (v + bend) / 0.025, u / 0.9);
    const double fibre = fibrous.at(u / 9, v + bend, std::max(2 * texel, 0.003));
    const double knot = plane_noise(seed + 3, u / 0.11, v / 0.06);
    const double dark = knot > 0.62 ? 2.2 * (knot - 0.62) : 0;
    const double fleck = plane_noise(seed + 4, u / 0.02, v / 0.012);
    return f(std::clamp(1 + 0.13 * ring + 0.10 * fibre - dark - (fleck > 0.55 ? 0.14 : 0), 0.2, 1.4)) * color;
  };
}

Pattern carpet(std::uint64_t seed, Rgb color) {
  const FractalNoise tufted(seed + 1, 0.05, 0.9), trodden(seed + 2, 0.9);
  return [=](double u, double v, double texel) {
    const double tone = 0.12 * (unit(cell(seed, u / 0.5, v / 0.5)) - 0.5);
    const double pile = tufted.at(u, v, std::max(2 * texel, 0.006));
    const double worn = trodden.at(u, v, 0.2);
    const double speckle = plane_noise(seed + 3, u / 0.022, v / 0.022);
    const double du = u / 0.5 - std::floor(u / 0.5), dv = v / 0.5 - std::floor(v / 0.5);
    const double joint = std::min(std::min(du, 1 - du), std::min(dv, 1 - dv)) < 0.008 ? 0.18 : 0;
    const double bright = speckle > 0.45 ? 0.32 : speckle < -0.5 ? -0.22 : 0;
    return f(1 + tone + 0.13 * pile + 0.07 * worn + bright - joint) * color;
  };
}

Pattern ceiling_panels(std::uint64_t seed) {
  const FractalNoise stained(seed + 1, 0.5), rough(seed + 2, 0.04, 0.8);
  return [=](double u, double v, double texel) {
    const double du = u / 0.6 - std::floor(u / 0.6), dv = v / 0.6 - std::floor(v / 0.6);
    const double edge = 0.6 * std::min(std::min(du, 1 - du), std::min(dv, 1 - dv));
    if (edge < 0.012) return edge < 0.004 ? Rgb{.62f, .62f, .60f} : Rgb{.93f, .93f, .92f};
    const double hole = plane_noise(seed, u / 0.017, v / 0.017);
    const double stain = stained.at(u, v, 0.1);
    const double fine = rough.at(u, v, std::max(2 * texel, 0.01));
    const double tone = 0.05 * (unit(cell(seed, u / 0.6, v / 0.6)) - 0.5);
    return f(0.86 + tone + 0.03 * stain + 0.03 * fine - (hole > 0.5 ? 0.2 : 0)) * Rgb{1, 1, .98f};
  };
}

Pattern cloth(std::uint64_t seed, Rgb color, int stripes) {
  const FractalNoise woven(seed, 0.03, 0.9), folded(seed + 1, 0.2);
  return [=](double u, double v, double texel) {
    const double weave = woven.at(u, v, std::max(2 * texel, 0.005));
    const double fold = folded.at(u, v / 2.5, 0.06);
    double tone = 1 + 0.10 * weave + 0.12 * fold;
    const double width = 0.035 + 0.03 * unit(mix(seed + 2));
    const auto band = [&](double x) { return x / width - std::floor(x / width) < 0.42; };
    if (stripes >= 1 && band(v)) tone *= 0.62;
    if (stripes >= 2 && band(u)) tone *= 0.70;
    return f(tone) * color;
  };
}

Pattern speckled(std::uint64_t seed, Rgb color) {
  const FractalNoise rough(seed + 2, 0.03, 0.85);
  return [=](double u, double v, double texel) {
    const double specks = plane_noise(seed, u / 0.016, v / 0.013),
                 blotches = plane_noise(seed + 1, u / 0.05, v / 0.05);
    const double fine = rough.at(u, v, std::max(2 * texel, 0.005));
    const double speck = specks > 0.42 ? -0.28 : specks < -0.5 ? 0.2 : 0;
    return f(1 + 0.07 * fine + 0.06 * blotches + speck) * color;
  };
}

Pattern grain(std::uint64_t seed, double strength) {
  const FractalNoise rough(seed, 0.06, 0.85);
  return [=](double u, double v, double texel) {
    const double fine = rough.at(u, v, std::max(2 * texel, 0.005));
    return f(0.93 + strength * fine) * Rgb{1, 1, 1};
  };
}

}  // namespace sediment::synthetic
