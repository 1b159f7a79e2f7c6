#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/scene/labels.hpp"

namespace sediment {

/// A point of a map. 24 bytes, as in a PCD file with fields x y z rgb label instance.
struct LabelledPoint {
  float x = 0, y = 0, z = 0;                ///< metres, world frame
  std::uint8_t b = 0, g = 0, r = 0, a = 0;  ///< PCL's order of a packed rgb in memory; a is unused and 0
  std::uint32_t label = kUnlabelled;
  std::uint32_t instance = 0;  ///< id of the instance in its frame, 0 = none
  friend bool operator==(const LabelledPoint&, const LabelledPoint&) = default;
};
static_assert(sizeof(LabelledPoint) == 24);

using LabelledCloud = std::vector<LabelledPoint>;

}  // namespace sediment
