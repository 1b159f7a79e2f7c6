#pragma once

#include "stages/movers/contradiction.hpp"

namespace sediment::movers {

struct RegionParameters {
  int min_views = 3;        ///< that see through a pixel, for it to be the seed of a region
  double min_share = 0.5;   ///< of the views that tell something about it, more than this
  double grow_share = 0.2;  ///< pixels with more than this join a seed that they lie beside
  double min_area = 0.001;  ///< of the image; smaller regions are speckle
};

/// The regions (CV_8UC1 on the grid, 0 or 255) that others see through: seeds, cleaned of what is narrower
/// than six pixels of the image, grown over pixels of their surface that are seen through less often, as a
/// thing that moves slowly hides where it was. They, and what `view` has masked as moved, are completed by
/// what goes on at their depth, is not seen both before and after, and has something behind it that is seen:
/// parts of a thing that has come to stay.
cv::Mat regions_of(const Verdicts& verdicts, const View& view, double depth_scale,
                   const RegionParameters& parameters);

/// Without what is narrower than six pixels of the image.
cv::Mat without_speckle(const cv::Mat& regions);

/// A mask of the image (255) from regions of the grid: the pixels of its cells, and those within `reach_px`
/// that go on at their depth. The grid leaves outlines open, as depths are not trusted there.
cv::Mat outlined(const cv::Mat& regions, const cv::Mat& depth, double depth_scale, int reach_px);

/// Whether a surface may go on from one depth to another beside it.
inline bool goes_on(double from_m, double to_m) {
  return std::abs(to_m - from_m) <= 0.02 + 0.02 * from_m;
}

}  // namespace sediment::movers
