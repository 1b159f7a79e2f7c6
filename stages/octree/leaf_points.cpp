#include "stages/octree/leaf_points.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pipeline/sorting/radix_sort.hpp"

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

std::uint64_t code_of_point(const LabelledPoint& point, double resolution_m) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) return kNotFinite;
  return code_of(key_of(point.x, resolution_m), key_of(point.y, resolution_m), key_of(point.z, resolution_m));
}

/// Codes without the bits in which they all agree. A scene is small beside the tree, but the origin is in the
/// middle of the tree: so it is within each of the eight octants that the upper bits are all the same.
/// Keeping the octant and the lower bits keeps the order, and the sort has half as many bits to look at.
class ShortCodes {
 public:
  explicit ShortCodes(const std::vector<std::uint64_t>& codes) {
    std::array<std::uint64_t, 8> any{}, all;
    all.fill(~std::uint64_t{0});
    for (const std::uint64_t code : codes) {
      any[code >> kOctantShift] |= code;
      all[code >> kOctantShift] &= code;
    }
    std::uint64_t varying = 0;
    for (std::size_t octant = 0; octant < 8; ++octant) {
      varying |= any[octant] & ~all[octant];
      upper_[octant] = all[octant];
    }
    low_bits_ = std::bit_width(varying);
    for (std::uint64_t& bits : upper_) bits &= ~low_mask();
  }

  int bits() const { return low_bits_ + 3; }
  std::uint64_t shorten(std::uint64_t code) const {
    return (code >> kOctantShift) << low_bits_ | (code & low_mask());
  }
  std::uint64_t restore(std::uint64_t short_code) const {
    return upper_[short_code >> low_bits_] | (short_code & low_mask());
  }

 private:
  static constexpr int kOctantShift = 3 * (kTreeDepth - 1);
  std::uint64_t low_mask() const { return (std::uint64_t{1} << low_bits_) - 1; }

  int low_bits_ = 0;
  std::array<std::uint64_t, 8> upper_{};  ///< of each octant: the bits in which its codes agree
};

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
  std::vector<std::uint64_t> codes(cloud.size());
  tbb::parallel_for(std::size_t{0}, cloud.size(),
                    [&](std::size_t i) { codes[i] = code_of_point(cloud[i], resolution_m); });
  std::vector<std::uint32_t> order;
  order.reserve(cloud.size());
  for (std::size_t i = 0; i < codes.size(); ++i)
    if (codes[i] != kNotFinite) order.push_back(static_cast<std::uint32_t>(i));
  std::erase(codes, kNotFinite);

  const ShortCodes short_codes(codes);
  for (std::uint64_t& code : codes) code = short_codes.shorten(code);
  sort_by_key(codes, order, short_codes.bits());

  SortedPoints sorted;
  sorted.not_finite = cloud.size() - codes.size();
  sorted.points.resize(codes.size());
  tbb::parallel_for(std::size_t{0}, codes.size(), [&](std::size_t i) {
    const LabelledPoint& point = cloud[order[i]];
    sorted.points[i] = {short_codes.restore(codes[i]), point.b, point.g, point.r, point.label};
  });
  return sorted;
}

}  // namespace sediment::octree
