#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "pipeline/scene/pose.hpp"
#include "stages/track/dense_frame.hpp"

namespace sediment::track {

constexpr float kLeastBrightnessNoise = 3;  // grey values

/// Median of absolute values from a histogram over [0, 64 * unit).
class AbsoluteHistogram {
 public:
  explicit AbsoluteHistogram(float unit) : unit_(unit) {}
  void add(float absolute) {
    ++bins_[std::min(static_cast<int>(absolute * (kBins / 64.0f) / unit_), kBins - 1)];
    ++count_;
  }
  /// 1.4826 times the median: the standard deviation of the good part; at least one unit.
  float robust_deviation() const {
    int below = 0, bin = 0;
    while (bin < kBins && below + bins_[bin] <= count_ / 2) below += bins_[bin++];
    return std::max(unit_, 1.4826f * unit_ * (64.0f / kBins) * (static_cast<float>(bin) + 0.5f));
  }

 private:
  static constexpr int kBins = 1024;
  float unit_;
  int count_ = 0;
  std::array<int, kBins> bins_{};
};

/// Normal equations: the upper triangle row by row, then the gradient. Sums of a row of pixels are kept
/// in single precision, their total in double.
struct NormalEquations {
  std::array<float, 27> row{};
  std::array<double, 27> total{};

  void add(const float* jacobian, float residual, float weight) {
    int k = 0;
    for (int a = 0; a < 6; ++a) {
      const float weighted = weight * jacobian[a];
      for (int b = a; b < 6; ++b) row[k++] += weighted * jacobian[b];
      row[21 + a] += weighted * residual;
    }
  }
  void flush() {
    for (int i = 0; i < 27; ++i) total[i] += static_cast<double>(row[i]);
    row.fill(0);
  }
};

/// Sums of a Gauss-Newton step, and what the next one's robust weights need.
struct DenseSums {
  NormalEquations equations;
  AbsoluteHistogram distances{1},
      differences{kLeastBrightnessNoise};  ///< of surfaces (in sigmas), of brightness
  double cross_brightness = 0, squared_brightness = 0;
  std::size_t seen = 0;
};

/// What the robust weights are scaled by.
struct DenseScales {
  float distance = 3;     ///< sigmas
  float brightness = 20;  ///< grey values
  float gain = 1;         ///< brightness of the current frame over that of the reference
};

/// Sums over the points of the reference that the current frame sees at the depth expected; `pose` is
/// current_from_reference, `depth_noise` the deviation of a depth by its square [1/m].
DenseSums sums_at(const DenseImage& reference, const DenseImage& current, const DenseCamera& camera,
                  int level, const Pose& pose, const DenseScales& scales, float depth_noise);

}  // namespace sediment::track
