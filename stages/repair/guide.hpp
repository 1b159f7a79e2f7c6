#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace sediment::repair {

/// What tells the surfaces of a frame apart, for a joint bilateral filter of `radius_px`: depth and colour as
/// planes of floats. All have a border, so that the neighbours of each pixel of the image can be read.
struct Guide {
  struct Tap {
    int dx, dy;
    float weight;
  };
  int radius_px = 0, border_px = 0;
  cv::Mat depth;          ///< depth units; far away from everything where there is none
  cv::Mat per_sigma;      ///< 1 / (how much depths of one surface differ); 0 where there is no depth
  cv::Mat certainty;      ///< of what depth says, 0 .. 1: less where there is none and colour decides
  cv::Mat color[3];       ///< smoothed
  std::vector<Tap> taps;  ///< neighbours that are asked
};

/// `depth` is CV_16UC1 in `depth_scale` units per metre, `color` CV_8UC3 of the same size.
Guide guide_of(const cv::Mat& depth, const cv::Mat& color, double depth_scale, int radius_px);

/// Mean of `share` (CV_32FC1, the part `where` of the image) over the pixels around that lie at a pixel's own
/// depth and have its colour, at the pixels of `band` (CV_8UC1, of the same part); the others, and those with
/// hardly any neighbour like them, keep their value.
cv::Mat mean_of_like(const cv::Mat& share, const cv::Rect& where, const cv::Mat& band, const Guide& guide);

}  // namespace sediment::repair
