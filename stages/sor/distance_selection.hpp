#pragma once

#include <cstddef>
#include <vector>

#include "stages/sor/spatial_order.hpp"

namespace sediment::sor {

/// Points to choose the nearest ones from, as three arrays that are padded to whole vectors.
class Candidates {
 public:
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  /// Appends `count` positions.
  void append(const float* x, const float* y, const float* z, std::size_t count);

  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }

 private:
  std::size_t size_ = 0;
  std::vector<float> x_, y_, z_;
};

/// The k smallest of some squared distances.
struct Nearest {
  double distance_sum = 0;  ///< sum of their square roots, in double as PCL does
  float squared_distance =
      0;  ///< at least the largest of them, and less than any that was not chosen unless equal
};

/// The `k` candidates nearest to `point` (all if there are fewer). Squared distances are formed in float, x
/// then y then z, as FLANN does. `scratch` is room that is used again.
Nearest nearest(const Candidates& candidates, Position point, std::size_t k, std::vector<float>& scratch);

}  // namespace sediment::sor
