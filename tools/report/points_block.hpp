#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "pipeline/scene/labels.hpp"
#include "pipeline/scene/vec3.hpp"
#include "tools/report/page.hpp"

namespace sediment::report {

/// A point as the viewer draws it.
struct ShownPoint {
  Vec3 position;  ///< metres, world frame
  std::uint8_t r = 0, g = 0, b = 0;
  std::uint32_t label = kUnlabelled;
};

/// Packs points for the page (see cloud_part): the bytes, and {count, origin, step, labels}.
struct PointsBlock {
  std::string bytes;
  Json facts;
};
PointsBlock pack(const std::vector<ShownPoint>& points, const LabelTable& labels);

}  // namespace sediment::report
