#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/motion/optical_flow.hpp"
#include "pipeline/scene/nearest_pixel.hpp"

namespace sediment {

/// Positions in some frame of the pixels of a regular grid of another frame: flow followed from frame to
/// frame.
struct PixelTrails {
  int step_px = 1, columns = 0, rows = 0;
  std::vector<float> u, v;           ///< pixels, row by row
  std::vector<std::uint16_t> depth;  ///< last depth seen on the way, depth units, 0 = none yet
  std::vector<std::uint8_t> valid;   ///< 0 once outside the image or behind or before something else
  std::vector<float> trust;          ///< 1, less for each step that the reverse flow does not lead back

  std::size_t size() const { return u.size(); }
  /// Value of an image at the nearest pixel of trail i, which must be valid.
  template <class T>
  T nearest(const cv::Mat& image, std::size_t i) const {
    return image.at<T>(nearest_pixel(v[i]), nearest_pixel(u[i]));
  }
};

/// How much the depth of one surface point may change from frame to frame.
struct DepthTolerance {
  double absolute_m = 0.1;
  double relative = 0.05;  ///< of the depth
};

/// The grid itself: a pixel in the middle of each step_px x step_px square, all valid. `depth` is CV_16UC1.
PixelTrails start_trails(const cv::Mat& depth, int step_px);

/// One frame further along `flow`, whose target has the depth image `depth` in `depth_scale` units per metre.
/// A trail ends (is no longer valid) where it leaves the image or the depth jumps; pixels without depth do
/// not end it. It keeps a quarter of its trust where the `reverse` flow does not lead back: it may have left
/// its surface, but may be right as well.
void follow(PixelTrails& trails, const FlowField& flow, const FlowField& reverse, const cv::Mat& depth,
            double depth_scale, const DepthTolerance& tolerance);

}  // namespace sediment
