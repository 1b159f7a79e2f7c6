#pragma once

namespace sediment {

/// The column (or row) of the pixel that a position along the image falls on: positions from -0.5 on. Rounds
/// as std::lround, without its call into the library.
inline int nearest_pixel(double position) {
  const double shifted = position + 0.5;
  return static_cast<int>(shifted);
}

}  // namespace sediment
