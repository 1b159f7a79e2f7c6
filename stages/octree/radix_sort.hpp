#pragma once

#include <vector>

#include "stages/octree/leaf_points.hpp"

namespace sediment::octree {

/// Sorts by code, stable, in parallel. Needs as much memory again.
void sort_by_code(std::vector<LeafPoint>& points);

}  // namespace sediment::octree
