#include "stages/octree/leaf_points.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

#include "stages/octree/radix_sort.hpp"

namespace sediment::octree {
namespace {

constexpr int kOriginKey = 1 << (kTreeDepth - 1);
constexpr std::uint64_t kNotFinite = ~std::uint64_t{0};

/// Spreads 16 bits to every third one.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ff0000ffULL;
  bits = (bits | bits << 8) & 0x00f00f00f00fULL;
  bits = (bits | bits << 4) & 0x0c30c30c30c3ULL;
  return (bits | bits << 2) & 0x249249249249ULL;
}

std::uint16_t gather(std::uint64_t bits) {
  bits &= 0x249249249249ULL;
  bits = (bits | bits >> 2) & 0x0c30c30c30c3ULL;
  bits = (bits | bits >> 4) & 0x00f00f00f00fULL;
  bits = (bits | bits >> 8) & 0x0000ff0000ffULL;
  return static_cast<std::uint16_t>(bits | bits >> 16);
}

LeafPoint leaf_point(const LabelledPoint& point, double resolution_m) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
    return {.code = kNotFinite};
  return {
      code_of(key_of(point.x, resolution_m), key_of(point.y, resolution_m), key_of(point.z, resolution_m)),
      point.b, point.g, point.r, point.label};
}

}  // namespace

std::uint16_t key_of(float coordinate_m, double resolution_m) {
  // As OcTreeBaseImpl::coordToKey does it: a product with 1 / resolution, in double.
  const double cell = std::floor(1.0 / resolution_m * static_cast<double>(coordinate_m));
  if (!(cell >= -kOriginKey && cell < kOriginKey))
    throw std::runtime_error("a point at " + std::to_string(coordinate_m) + " m lies outside the tree: at " +
                             std::to_string(resolution_m) + " m it reaches " +
                             std::to_string(kOriginKey * resolution_m) + " m from the origin");
  return static_cast<std::uint16_t>(static_cast<int>(cell) + kOriginKey);
}

std::uint64_t code_of(std::uint16_t key_x, std::uint16_t key_y, std::uint16_t key_z) {
  return spread(key_x) | spread(key_y) << 1 | spread(key_z) << 2;
}

Keys keys_of(std::uint64_t code) {
  return {gather(code), gather(code >> 1), gather(code >> 2)};
}

SortedPoints sort_into_leaves(std::span<const LabelledPoint> cloud, double resolution_m) {
  SortedPoints sorted;
  sorted.points.resize(cloud.size());
  tbb::parallel_for(std::size_t{0}, cloud.size(),
                    [&](std::size_t i) { sorted.points[i] = leaf_point(cloud[i], resolution_m); });
  sorted.not_finite = std::erase_if(sorted.points, [](const LeafPoint& p) { return p.code == kNotFinite; });
  sort_by_code(sorted.points);
  return sorted;
}

}  // namespace sediment::octree
