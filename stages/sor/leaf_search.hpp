#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "stages/sor/candidates.hpp"
#include "stages/sor/nearest_kernel.hpp"
#include "stages/sor/point_tree.hpp"

namespace sediment::sor {

/// Exact neighbours of the points of one leaf of the tree after the other.
class LeafSearch {
 public:
  /// The tree has more than `k` points.
  LeafSearch(const PointTree& tree, std::size_t k, const NearestKernel& kernel)
      : tree_(tree), k_(k), kernel_(kernel) {}

  /// Mean distances of the leaf's points to their k nearest neighbours, written to means_m[i] where i is the
  /// point's index in the input. Safe to call from several threads with candidates of their own.
  void run(std::size_t leaf, Candidates& candidates, std::span<float> means_m) const;

 private:
  /// A group of points of the leaf that is searched together: all of them, or one.
  struct Group {
    std::size_t begin, end;
    Box box;
    Position center;
    float radius_m;
    std::array<float, 6> corners;  ///< of the box, for the kernel
  };
  Group group_of(std::size_t begin, std::size_t end, const Box& box) const;
  void run(const Group& group, float reach_m, Candidates& candidates, std::span<float> means_m) const;
  float rough_reach_m(std::size_t leaf, const Group& group, Candidates& candidates) const;
  float gather(const Group& group, float reach_m, Candidates& candidates) const;
  void visit_all(std::size_t level, std::size_t first, const Group& group, float limit,
                 Candidates& candidates) const;
  void visit_nearest(std::size_t level, std::size_t first, const Group& group, float& reach_m,
                     std::size_t& room, Candidates& candidates) const;
  void append_leaf(std::size_t leaf, Candidates& candidates) const;
  float shrink(const Group& group, Candidates& candidates) const;

  const PointTree& tree_;
  std::size_t k_;
  const NearestKernel& kernel_;
};

}  // namespace sediment::sor
