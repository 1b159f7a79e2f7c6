#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "tools/truth/share.hpp"

namespace sediment::tools {

/// Pixels of a mask against a true one.
struct Overlap {
  std::uint64_t hit = 0;     ///< in both
  std::uint64_t extra = 0;   ///< only in the mask
  std::uint64_t missed = 0;  ///< only in the truth
  std::uint64_t none = 0;    ///< in neither

  /// None where there is nothing to divide by: no pixel in either, in the mask, in the truth.
  std::optional<double> iou() const { return share(hit, hit + extra + missed); }
  std::optional<double> precision() const { return share(hit, hit + extra); }
  std::optional<double> recall() const { return share(hit, hit + missed); }
  std::uint64_t pixels() const { return hit + extra + missed + none; }
  Overlap& operator+=(const Overlap& other);
};

/// Not 0 counts as in the mask. Both CV_8UC1 of one size.
Overlap overlap_of(const cv::Mat& truth, const cv::Mat& mask);

/// Boundary F of two masks: harmonic mean of the shares of boundary pixels that have one of the other mask
/// within `radius_px`; a boundary pixel lies in the mask and has a neighbour (of 4) outside. None if neither
/// has a boundary; 0 if only one has. Source: the contour measure of DAVIS (Perazzi et al., CVPR 2016).
std::optional<double> boundary_f(const cv::Mat& truth, const cv::Mat& mask, int radius_px);

/// DAVIS's radius: 0.8 % of the image's diagonal, rounded up.
int boundary_radius_px(cv::Size image);

}  // namespace sediment::tools
