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
constexpr std::array<std::uint16_t, kTable> kRandom = [] {
  std::array<std::uint16_t, kTable> numbers{};
  for (std::size_t i = 0; i < kTable; ++i) numbers[i] = static_cast<std::uint16_t>(hash(0x5eed, i) >> 48);
  return numbers;
}();

// One of 16 unit gradients, dotted with the offset from its lattice point.
inline float gradient_dot(unsigned direction, float dx, float dy) {
  static constexpr float kGradient[16][2] = {
      {1, 0},  {.923880f, .382683f},   {.707107f, .707107f},   {.382683f, .923880f},
      {0, 1},  {-.382683f, .923880f},  {-.707107f, .707107f},  {-.923880f, .382683f},
      {-1, 0}, {-.923880f, -.382683f}, {-.707107f, -.707107f}, {-.382683f, -.923880f},
      {0, -1}, {.382683f, -.923880f},  {.707107f, -.707107f},  {.923880f, -.382683f}};
  const float* gradient = kGradient[direction & 15];
  return gradient[0] * dx + gradient[1] * dy;
}

// std::floor is a call into the library on baseline x86-64.
inline std::int64_t floor_of(double x) {
  const auto towards_zero = static_cast<std::int64_t>(x);
  return towards_zero - (x < static_cast<double>(towards_zero));
}

inline float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

inline float mixed(float from, float to, float fraction) {
  return from + fraction * (to - from);
}

inline double noise_at(std::uint64_t seed, double x, double y) {
  const std::array<std::uint16_t, kTable>& table = kRandom;
  const std::int64_t column = floor_of(x), row = floor_of(y);
  const auto i = static_cast<std::uint64_t>(column) + (seed & 0xffff);
  const auto j = static_cast<std::uint64_t>(row) + (seed >> 16 & 0xffff);
  const float dx = static_cast<float>(x - static_cast<double>(column)),
              dy = static_cast<float>(y - static_cast<double>(row)), sx = fade(dx);
  const unsigned left = table[i % kTable], right = table[(i + 1) % kTable],
                 turn = static_cast<unsigned>(seed >> 32);
  const auto direction = [&](unsigned side, std::uint64_t r) { return table[(side + r) % kTable] + turn; };
  const float low =
      mixed(gradient_dot(direction(left, j), dx, dy), gradient_dot(direction(right, j), dx - 1, dy), sx);
  const float high = mixed(gradient_dot(direction(left, j + 1), dx, dy - 1),
                           gradient_dot(direction(right, j + 1), dx - 1, dy - 1), sx);
  return 1.5f * mixed(low, high, fade(dy));
}

}  // namespace

double plane_noise(std::uint64_t seed, double x, double y) {
  return noise_at(seed, x, y);
}

FractalNoise::FractalNoise(std::uint64_t seed, double coarsest_m, double gain) {
  double width_m = coarsest_m, strength = 1, power = 0;
  for (Octave& octave : octaves_) {
    power += strength * strength;
    octave = {width_m, 1 / width_m, mix(seed + static_cast<std::uint64_t>(1e6 * width_m)), strength,
              1 / std::sqrt(power)};
    width_m /= 2, strength *= gain;
  }
}

double FractalNoise::at(double x_m, double y_m, double finest_m) const {
  double sum = 0, normalise = 0;
  for (const Octave& octave : octaves_) {
    if (octave.width_m < finest_m) break;
    sum += octave.strength * noise_at(octave.seed, x_m * octave.per_m, y_m * octave.per_m);
    normalise = octave.normalise;
  }
  return sum * normalise;
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
