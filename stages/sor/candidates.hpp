#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "stages/sor/nearest_kernel.hpp"
#include "stages/sor/point_tree.hpp"

namespace sediment::sor {

/// Points to choose the nearest ones from, and room to do it in. Used again from leaf to leaf.
class Candidates {
 public:
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  void shrink(std::size_t size) { size_ = size; }

  /// Appends points of the tree.
  void append(const PointTree& tree, std::size_t begin, std::size_t count) {
    reserve(size_ + count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float* to = axes_[axis].data() + size_;
      const float* from = tree.axes[axis].data() + begin;
      // A leaf is shorter than that as a rule: one copy of fixed length in place of a call. Both sides have
      // room.
      if (count <= kStep)
        std::memcpy(to, from, kStep * sizeof(float));
      else
        std::memcpy(to, from, count * sizeof(float));
    }
    size_ += count;
  }

  /// The points, followed by points infinitely far away.
  Coordinates coordinates() {
    reserve(size_);
    for (std::size_t i = 0; i < kStep; ++i) axes_[0][size_ + i] = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < kStep; ++i) axes_[1][size_ + i] = axes_[2][size_ + i] = 0;
    return {axes_[0].data(), axes_[1].data(), axes_[2].data(), size_};
  }
  float* scratch() { return scratch_.data(); }

 private:
  static constexpr std::size_t kStep = PointTree::kPadding;

  void reserve(std::size_t size) {
    if (scratch_.size() >= size + 2 * kStep) return;
    for (auto& axis : axes_) axis.resize(2 * size + 2 * kStep);
    scratch_.resize(2 * size + 2 * kStep);
  }

  std::size_t size_ = 0;
  std::array<std::vector<float>, 3> axes_;
  std::vector<float> scratch_;
};

}  // namespace sediment::sor
