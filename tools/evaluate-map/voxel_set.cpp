#include "tools/evaluate-map/voxel_set.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace sediment::tools {
namespace {

constexpr std::int32_t kReach = 1 << 20;  // cells from the origin, in each direction
constexpr int kBits = 21;
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

std::vector<Voxel> around(Voxel voxel) {
  std::vector<Voxel> cells;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) cells.push_back({voxel.x + dx, voxel.y + dy, voxel.z + dz});
  return cells;
}

}  // namespace

Voxel VoxelSet::voxel_of(Vec3 point) const {
  const double x = std::floor(point.x / side_m_), y = std::floor(point.y / side_m_),
               z = std::floor(point.z / side_m_);
  if (!(std::abs(x) < kReach - 1 && std::abs(y) < kReach - 1 && std::abs(z) < kReach - 1))
    throw std::runtime_error("a point is not finite or further than " + std::to_string(kReach) +
                             " cells from the origin");
  return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(z)};
}

Vec3 VoxelSet::center_of(Voxel voxel) const {
  return {(voxel.x + 0.5) * side_m_, (voxel.y + 0.5) * side_m_, (voxel.z + 0.5) * side_m_};
}

bool VoxelSet::contains_or_face(Voxel v) const {
  return contains(v) || contains({v.x - 1, v.y, v.z}) || contains({v.x + 1, v.y, v.z}) ||
         contains({v.x, v.y - 1, v.z}) || contains({v.x, v.y + 1, v.z}) || contains({v.x, v.y, v.z - 1}) ||
         contains({v.x, v.y, v.z + 1});
}

bool VoxelSet::contains_near(Voxel voxel) const {
  const auto cells = around(voxel);
  return std::any_of(cells.begin(), cells.end(), [&](Voxel cell) { return contains(cell); });
}

std::vector<Voxel> VoxelSet::sorted() const {
  std::vector<Voxel> voxels;
  voxels.reserve(keys_.size());
  for (const std::uint64_t key : keys_)
    voxels.push_back({static_cast<std::int32_t>(key & kMask) - kReach,
                      static_cast<std::int32_t>(key >> kBits & kMask) - kReach,
                      static_cast<std::int32_t>(key >> 2 * kBits & kMask) - kReach});
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

std::uint64_t VoxelSet::key_of(Voxel v) {
  return static_cast<std::uint64_t>(v.x + kReach) | static_cast<std::uint64_t>(v.y + kReach) << kBits |
         static_cast<std::uint64_t>(v.z + kReach) << 2 * kBits;
}

std::vector<std::size_t> cluster_sizes(const VoxelSet& voxels) {
  std::vector<std::size_t> sizes;
  VoxelSet visited(voxels.side_m());
  for (const Voxel start : voxels.sorted()) {
    if (visited.contains(start)) continue;
    std::vector<Voxel> open{start};
    visited.insert(start);
    std::size_t size = 0;
    while (!open.empty()) {
      const Voxel at = open.back();
      open.pop_back();
      ++size;
      for (const Voxel next : around(at))
        if (voxels.contains(next) && !visited.contains(next)) {
          visited.insert(next);
          open.push_back(next);
        }
    }
    sizes.push_back(size);
  }
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
}

}  // namespace sediment::tools
