#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

namespace sediment::interaction_mask {

/// Sums over all pixel pairs of two instances that lie close together. Whole numbers, so exact and the same
/// in any order.
struct ContactSum {
  std::uint64_t pixel_pairs = 0;       ///< N: pairs within the radius, both with depth
  std::uint64_t depth_difference = 0;  ///< sum of |depth(a) - depth(b)| over them, depth units
  friend bool operator==(const ContactSum&, const ContactSum&) = default;
};

/// The sums of steps 1 to 3 of section 3.2 for every pair of a prior dynamic and a prior static instance:
/// over all pixels a of the one and b of the other with |a - b| <= radius_px (Euclidean) and depth at both.
///
/// `ids` is CV_16UC1, `depth` CV_16UC1 of the same size, 0 = no depth. The result holds
/// dynamic_ids.size() * static_ids.size() sums, the static instances of the first dynamic one first. Throws
/// std::invalid_argument if types or sizes do not fit or an id is outside 1 .. 65535.
///
/// Cost: the runs of each row once, then only the pairs themselves; pixels away from a contact are never
/// touched.
std::vector<ContactSum> contact_sums(const cv::Mat& ids, const cv::Mat& depth,
                                     std::span<const int> dynamic_ids, std::span<const int> static_ids,
                                     double radius_px);

}  // namespace sediment::interaction_mask
