#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stages/sor/nearest_kernel.hpp"
#include "stages/sor/position.hpp"

namespace sediment::sor {

/// Equation (9): for each point the mean distance in metres to its `k` nearest neighbours, the point itself
/// left out (another point at the same place is a neighbour at distance 0). The neighbours are exact. Where
/// the cloud has no `k` others, the mean is over those there are; a single point gets 0. Coordinates must be
/// finite. Distances are rounded as in pcl::StatisticalOutlierRemoval: squares in float, roots and sum in
/// double, the mean to float.
/// Every kernel gives the same bits.
std::vector<float> mean_neighbor_distances(std::span<const Position> points, std::size_t k,
                                           const NearestKernel& kernel = *available_kernels().back());

}  // namespace sediment::sor
