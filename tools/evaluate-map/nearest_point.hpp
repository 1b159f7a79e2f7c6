#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/scene/vec3.hpp"

namespace sediment::tools {

/// Exact nearest neighbours among fixed points, by a k-d tree.
class NearestPoint {
 public:
  explicit NearestPoint(std::vector<Vec3> points);

  struct Found {
    std::size_t point_idx = 0;  ///< in the order of the points given; the smallest of equally near ones
    double distance_m = 0;
    std::size_t tree_idx = 0;  ///< for find_all
  };
  /// Undefined without points. Safe to call from several threads.
  Found find(Vec3 query) const;
  /// The same of many, in parallel; quick if queries that follow each other are near each other.
  std::vector<Found> find_all(const std::vector<Vec3>& queries) const;
  /// Whether a point is at most `radius_m` away. Safe to call from several threads.
  bool has_within(Vec3 query, double radius_m) const;
  bool empty() const { return points_.empty(); }

 private:
  void build(std::size_t begin, std::size_t end);
  Found find_from(Vec3 query, std::size_t tree_idx) const;
  void search(std::size_t begin, std::size_t end, Vec3 query, Found& best) const;

  /// The tree: the middle of a range splits it along its widest axis.
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> given_idx_;  ///< of the point, in the order given
  std::vector<std::uint8_t> axis_;        ///< of the range whose middle is there
};

}  // namespace sediment::tools
