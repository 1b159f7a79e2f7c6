#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/scene/labelled_point.hpp"

namespace sediment::test {

struct NamedCloud {
  std::string name;
  LabelledCloud points;
};

/// Clouds that a neighbour search can trip over: a noisy room, clusters of very different density, points at
/// one place, a lattice (equal distances everywhere), far outliers, a plane, a line, coordinates around a
/// million metres.
std::vector<NamedCloud> awkward_clouds(std::size_t size, std::uint32_t seed);

/// The walls of a room of 6 x 5 x 3 m with 5 mm of noise and 1 % of points anywhere in it.
LabelledCloud noisy_room(std::size_t size, std::uint32_t seed);

}  // namespace sediment::test
