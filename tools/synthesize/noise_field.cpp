#include "tools/synthesize/noise_field.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

constexpr std::size_t kTable = 4096;

// Random numbers by table: a cell's number costs two look-ups. Repeats after 4096 cells, further than any
// wall.
const std::array<std::uint16_t, kTable>& random_table() {
  static const std::array<std::uint16_t, kTable> table = [] {
    std::array<std::uint16_t, kTable> numbers{};
    for (std::size_t i = 0; i < kTable; ++i) numbers[i] = static_cast<std::uint16_t>(hash(0x5eed, i) >> 48);
    return numbers;
  }();
  return table;
}

// One of 16 unit gradients, dotted with the offset from its lattice point.
inline float gradient_dot(unsigned direction, float dx, float dy) {
  static constexpr float kC[16] = {1,  .923880f,  .707107f,  .382683f,  0, -.382683f, -.707107f, -.923880f,
                                   -1, -.923880f, -.707107f, -.382683f, 0, .382683f,  .707107f,  .923880f};
  return kC[direction & 15] * dx + kC[(direction + 12) & 15] * dy;
}

inline float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

inline float mixed(float from, float to, float fraction) {
  return from + fraction * (to - from);
}

}  // namespace

double plane_noise(std::uint64_t seed, double x, double y) {
  static const std::array<std::uint16_t, kTable>& table = random_table();
  const double column = std::floor(x), row = std::floor(y);
  const auto i = static_cast<std::uint64_t>(static_cast<std::int64_t>(column)) + (seed & 0xffff);
  const auto j = static_cast<std::uint64_t>(static_cast<std::int64_t>(row)) + (seed >> 16 & 0xffff);
  const float dx = static_cast<float>(x - column), dy = static_cast<float>(y - row), sx = fade(dx);
  const unsigned left = table[i % kTable], right = table[(i + 1) % kTable],
                 turn = static_cast<unsigned>(seed >> 32);
  const auto direction = [&](unsigned side, std::uint64_t r) { return table[(side + r) % kTable] + turn; };
  const float low =
      mixed(gradient_dot(direction(left, j), dx, dy), gradient_dot(direction(right, j), dx - 1, dy), sx);
  const float high = mixed(gradient_dot(direction(left, j + 1), dx, dy - 1),
                           gradient_dot(direction(right, j + 1), dx - 1, dy - 1), sx);
  return 1.5f * mixed(low, high, fade(dy));
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
