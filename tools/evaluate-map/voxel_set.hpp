#pragma once

#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "pipeline/scene/vec3.hpp"

namespace sediment::tools {

/// A cell of a regular grid by its whole coordinates.
struct Voxel {
  std::int32_t x = 0, y = 0, z = 0;
  friend bool operator==(const Voxel&, const Voxel&) = default;
  friend auto operator<=>(const Voxel&, const Voxel&) = default;
};

/// Cells of one size. Cells begin at whole multiples of the side.
class VoxelSet {
 public:
  explicit VoxelSet(double side_m) : side_m_(side_m) {}

  double side_m() const { return side_m_; }
  /// Of a finite point within 2^20 cells of the origin; throws std::runtime_error for another.
  Voxel voxel_of(Vec3 point) const;
  Vec3 center_of(Voxel voxel) const;

  void insert(Voxel voxel) { keys_.insert(key_of(voxel)); }
  void insert(Vec3 point) { insert(voxel_of(point)); }
  bool contains(Voxel voxel) const { return keys_.contains(key_of(voxel)); }
  /// The cell itself or one of the 6 that share a face with it.
  bool contains_or_face(Voxel voxel) const;
  /// The cell itself or one of the 26 around it.
  bool contains_near(Voxel voxel) const;
  std::size_t size() const { return keys_.size(); }
  /// In ascending order.
  std::vector<Voxel> sorted() const;

 private:
  static std::uint64_t key_of(Voxel voxel);

  double side_m_;
  std::unordered_set<std::uint64_t> keys_;
};

/// Sizes of the groups of cells that touch (26 neighbours), the largest first.
std::vector<std::size_t> cluster_sizes(const VoxelSet& voxels);

}  // namespace sediment::tools
