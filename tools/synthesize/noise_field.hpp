#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace sediment::synthetic {

/// Smooth noise over the plane in -1 .. 1 whose features are about one unit wide: gradient noise (Perlin).
double plane_noise(std::uint64_t seed, double x, double y);

/// Octaves of plane_noise from `coarsest_m` downwards, each half as wide and `gain` times as strong as the
/// one before; about -1 .. 1.
class FractalNoise {
 public:
  FractalNoise(std::uint64_t seed, double coarsest_m, double gain = 0.55);

  /// Down to octaves of `finest_m`. What is finer than two texels must not be asked for: it would alias.
  double at(double x_m, double y_m, double finest_m) const;

 private:
  struct Octave {
    double width_m, per_m;
    std::uint64_t seed;
    double strength;   ///< of the first is 1
    double normalise;  ///< for a sum that ends with this octave: the noise keeps its variance
  };
  std::array<Octave, 10> octaves_;
};

/// A smooth random function of time whose spectrum lies between two frequencies: a sum of sines with random
/// phases, root mean square 1.
class BandLimitedNoise {
 public:
  BandLimitedNoise(std::uint64_t seed, double lowest_hz, double highest_hz);
  double at(double time_s) const;

 private:
  struct Tone {
    double radians_per_s, phase, amplitude;
  };
  std::vector<Tone> tones_;
};

}  // namespace sediment::synthetic
