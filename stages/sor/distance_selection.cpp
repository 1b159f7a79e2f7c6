#include "stages/sor/distance_selection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace sediment::sor {
namespace {

constexpr std::size_t kLanes = 8;

/// Squared distances that are at most `limit`.
std::size_t count_within(const float* squared, std::size_t count, float limit) {
  std::uint32_t within = 0;
  for (std::size_t i = 0; i < count; ++i) within += squared[i] <= limit ? 1 : 0;
  return within;
}

/// Where the k smallest end: `below` of them are at most `low`, the others are equal to `high`.
struct Cut {
  float low = 0, high = 0;
  std::size_t below = 0;
};

/// Narrows an interval of limits by counting: interpolation first, since counts grow smoothly with the square
/// of the distance, then bisection over the bit patterns of the floats, which are ordered as their values
/// are.
Cut cut_after(const float* squared, std::size_t count, std::size_t k) {
  float low = -1, high = 0;
  for (std::size_t i = 0; i < count; ++i) high = std::max(high, squared[i]);
  std::size_t below = 0, within = count;
  if (within == k) return {high, high, k};
  if (const std::size_t at_zero = count_within(squared, count, 0); at_zero >= k)
    return {-1, 0, 0};
  else
    below = at_zero;
  low = 0;
  for (int step = 0; std::bit_cast<std::uint32_t>(high) - std::bit_cast<std::uint32_t>(low) > 1; ++step) {
    const float share = (static_cast<float>(k - below) + 0.5f) / static_cast<float>(within - below + 1);
    float limit = low + (high - low) * share;
    if (step >= 8 || !(limit > low && limit < high)) {
      const std::uint32_t a = std::bit_cast<std::uint32_t>(low), b = std::bit_cast<std::uint32_t>(high);
      limit = std::bit_cast<float>(a + (b - a) / 2);
    }
    const std::size_t counted = count_within(squared, count, limit);
    if (counted == k) return {limit, limit, k};
    if (counted < k) {
      low = limit;
      below = counted;
    } else {
      high = limit;
      within = counted;
    }
  }
  return {low, high, below};
}

double sum_of_roots(const float* squared, std::size_t count, float limit) {
  double lanes[kLanes] = {};
  for (std::size_t i = 0; i < count; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float value = squared[i + lane];
      lanes[lane] += value <= limit ? std::sqrt(static_cast<double>(value)) : 0.0;
    }
  return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

}  // namespace

void Candidates::append(const float* x, const float* y, const float* z, std::size_t count) {
  const std::size_t room = (size_ + count + kLanes - 1) / kLanes * kLanes;
  if (x_.size() < room)
    for (auto* axis : {&x_, &y_, &z_}) axis->resize(room * 2);
  std::copy_n(x, count, x_.data() + size_);
  std::copy_n(y, count, y_.data() + size_);
  std::copy_n(z, count, z_.data() + size_);
  size_ += count;
}

Nearest nearest(const Candidates& candidates, Position point, std::size_t k, std::vector<float>& scratch) {
  const std::size_t count = candidates.size();
  const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
  if (scratch.size() < padded) scratch.resize(padded * 2);
  float* squared = scratch.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = candidates.x()[i] - point.x;
    const float dy = candidates.y()[i] - point.y;
    const float dz = candidates.z()[i] - point.z;
    squared[i] = dx * dx + dy * dy + dz * dz;
  }
  std::fill(squared + count, squared + padded, INFINITY);
  if (count <= k) return {sum_of_roots(squared, padded, 3.4e38f), INFINITY};
  const Cut cut = cut_after(squared, count, k);
  const double ties = static_cast<double>(k - cut.below) * std::sqrt(static_cast<double>(cut.high));
  return {sum_of_roots(squared, padded, cut.low) + ties, cut.high};
}

}  // namespace sediment::sor
