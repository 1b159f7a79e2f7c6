#pragma once

#include "tools/synthesize/random.hpp"
#include "tools/synthesize/texture.hpp"

namespace sediment::synthetic {

/// A colour that prints, book covers and cloth have: one of a set of pigments, a little lighter or darker.
Rgb pigment(Random& random);
/// The same, pale: paper, backgrounds.
Rgb pale(Random& random);
inline Rgb gray(double value) {
  const float g = static_cast<float>(value);
  return {g, g, g};
}

}  // namespace sediment::synthetic
