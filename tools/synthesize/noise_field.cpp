#include "tools/synthesize/noise_field.hpp"

#include <cmath>
#include <numbers>

#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

// One of 16 unit gradients, dotted with the offset from its lattice point.
double gradient_dot(std::uint64_t seed, std::int64_t column, std::int64_t row, double dx, double dy) {
  static constexpr double kC[16] = {1,  .923880,  .707107,  .382683,  0, -.382683, -.707107, -.923880,
                                    -1, -.923880, -.707107, -.382683, 0, .382683,  .707107,  .923880};
  const std::uint64_t bits = mix(seed ^ (static_cast<std::uint64_t>(column) * 0x9e3779b97f4a7c15u +
                                         static_cast<std::uint64_t>(row) * 0xc2b2ae3d27d4eb4fu));
  const unsigned direction = static_cast<unsigned>(bits >> 60);
  return kC[direction] * dx + kC[(direction + 12) & 15] * dy;
}

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

}  // namespace

double plane_noise(std::uint64_t seed, double x, double y) {
  const double column = std::floor(x), row = std::floor(y);
  const auto i = static_cast<std::int64_t>(column), j = static_cast<std::int64_t>(row);
  const double dx = x - column, dy = y - row, sx = fade(dx), sy = fade(dy);
  const double low =
      std::lerp(gradient_dot(seed, i, j, dx, dy), gradient_dot(seed, i + 1, j, dx - 1, dy), sx);
  const double high = std::lerp(gradient_dot(seed, i, j + 1, dx, dy - 1),
                                gradient_dot(seed, i + 1, j + 1, dx - 1, dy - 1), sx);
  return 1.5 * std::lerp(low, high, sy);
}

double fractal_noise(std::uint64_t seed, double x_m, double y_m, double coarsest_m, double finest_m,
                     double gain) {
  double sum = 0, strength = 1, total = 0;
  for (double width_m = coarsest_m; width_m >= finest_m; width_m /= 2, strength *= gain) {
    sum += strength *
           plane_noise(mix(seed + static_cast<std::uint64_t>(1e6 * width_m)), x_m / width_m, y_m / width_m);
    total += strength * strength;
  }
  return total > 0 ? sum / std::sqrt(total) : 0;
}

BandLimitedNoise::BandLimitedNoise(std::uint64_t seed, double lowest_hz, double highest_hz) {
  constexpr int kTones = 9;
  Random random(seed);
  for (int tone = 0; tone < kTones; ++tone) {
    // Spread over the band in equal ratios; slower tones are stronger, as in a hand's tremor.
    const double position = (tone + random.uniform()) / kTones;
    const double hz = lowest_hz * std::pow(highest_hz / lowest_hz, position);
    tones_.push_back({2 * std::numbers::pi * hz, random.uniform(0, 2 * std::numbers::pi), lowest_hz / hz});
  }
  double power = 0;
  for (const Tone& tone : tones_) power += tone.amplitude * tone.amplitude / 2;
  for (Tone& tone : tones_) tone.amplitude /= std::sqrt(power);
}

double BandLimitedNoise::at(double time_s) const {
  double sum = 0;
  for (const Tone& tone : tones_) sum += tone.amplitude * std::sin(tone.radians_per_s * time_s + tone.phase);
  return sum;
}

}  // namespace sediment::synthetic
