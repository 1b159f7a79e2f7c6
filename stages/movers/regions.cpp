#include "stages/movers/regions.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/scene/frame.hpp"

namespace sediment::movers {
namespace {

/// Seeds and what may join them.
struct Marks {
  cv::Mat seeds, open;
};

Marks marks_of(const Verdicts& verdicts, const RegionParameters& parameters) {
  Marks marks{cv::Mat(verdicts.through.size(), CV_8UC1, cv::Scalar(0)),
              cv::Mat(verdicts.through.size(), CV_8UC1, cv::Scalar(0))};
  for (int y = 0; y < marks.seeds.rows; ++y)
    for (int x = 0; x < marks.seeds.cols; ++x) {
      const int through = verdicts.through.at<std::uint8_t>(y, x),
                told = through + verdicts.hits.at<std::uint8_t>(y, x);
      if (through == 0) continue;
      if (through >= parameters.min_views && through > parameters.min_share * told)
        marks.seeds.at<std::uint8_t>(y, x) = 255;
      if (through > parameters.grow_share * told) marks.open.at<std::uint8_t>(y, x) = 255;
    }
  return marks;
}

/// Fills `regions` over open pixels whose depth goes on from that of a neighbour inside.
void grow(cv::Mat& regions, const cv::Mat& open, const cv::Mat& depth, double depth_scale) {
  std::vector<cv::Point> front;
  for (int y = 0; y < regions.rows; ++y)
    for (int x = 0; x < regions.cols; ++x)
      if (regions.at<std::uint8_t>(y, x)) front.emplace_back(x, y);
  const auto depth_at = [&](const cv::Point& p) {
    return depth.at<std::uint16_t>(pixel_of(p)) / depth_scale;
  };
  const cv::Rect image({}, regions.size());
  while (!front.empty()) {
    const cv::Point from = front.back();
    front.pop_back();
    for (const cv::Point& way : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point to = from + way;
      if (!image.contains(to) || regions.at<std::uint8_t>(to) || !open.at<std::uint8_t>(to)) continue;
      const double z = depth_at(from);
      if (!goes_on(z, depth_at(to))) continue;
      regions.at<std::uint8_t>(to) = 255;
      front.push_back(to);
    }
  }
}

/// Adds to `regions` what goes on at their depth, or at that of a moved thing masked already, is not seen
/// both before and after, and has something behind it that is. Floor that comes into sight, too, is not seen
/// before; what hid it then was nearer.
void add_rest(cv::Mat& regions, const Verdicts& verdicts, const View& view, double depth_scale,
              int min_views) {
  cv::Mat masked;
  cv::resize(view.dynamic, masked, regions.size(), 0, 0, cv::INTER_NEAREST);
  const cv::Mat known = (regions | (masked == kNonPriorDynamic)) & (masked != kPriorDynamic);
  const cv::Mat open =
      (verdicts.lasting == 0) & (verdicts.through + verdicts.beyond >= min_views) & (masked == kStatic);
  cv::Mat rest = known.clone();
  grow(rest, open, view.depth, depth_scale);
  rest &= known == 0;
  regions |= without_speckle(rest);
}

/// Of the grid's morphology.
cv::Mat ball() {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3});
}

}  // namespace

cv::Mat without_speckle(const cv::Mat& regions) {
  cv::Mat wide;
  cv::morphologyEx(regions, wide, cv::MORPH_OPEN, ball());
  return wide;
}

cv::Mat regions_of(const Verdicts& verdicts, const View& view, double depth_scale,
                   const RegionParameters& parameters) {
  const Marks marks = marks_of(verdicts, parameters);
  cv::Mat regions = without_speckle(marks.seeds);
  grow(regions, marks.open, view.depth, depth_scale);
  add_rest(regions, verdicts, view, depth_scale, parameters.min_views);
  cv::morphologyEx(regions, regions, cv::MORPH_CLOSE, ball(), {-1, -1}, 2);
  cv::Mat labels, statistics, centres;
  const int count = cv::connectedComponentsWithStats(regions, labels, statistics, centres, 8);
  const double least = parameters.min_area * regions.rows * regions.cols;
  for (int y = 0; y < regions.rows; ++y)
    for (int x = 0; x < regions.cols; ++x)
      if (count > 1 && statistics.at<int>(labels.at<int>(y, x), cv::CC_STAT_AREA) < least)
        regions.at<std::uint8_t>(y, x) = 0;
  return regions;
}

cv::Mat outlined(const cv::Mat& regions, const cv::Mat& depth, double depth_scale, int reach_px) {
  cv::Mat mask, nearest, farthest, inside;
  cv::resize(regions, mask, depth.size(), 0, 0, cv::INTER_NEAREST);
  if (cv::countNonZero(mask) == 0) return mask;
  const cv::Mat window = cv::Mat::ones(2 * reach_px + 1, 2 * reach_px + 1, CV_8UC1);
  inside = cv::Mat(depth.size(), CV_16UC1, cv::Scalar(0));
  depth.copyTo(inside, mask);
  cv::dilate(inside, farthest, window);
  inside.setTo(65535, inside == 0);
  cv::erode(inside, nearest, window);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      const double here = depth.at<std::uint16_t>(y, x);
      if (mask.at<std::uint8_t>(y, x) || here == 0 || farthest.at<std::uint16_t>(y, x) == 0) continue;
      const double tolerance = 0.02 * depth_scale + 0.01 * here;
      if (here >= nearest.at<std::uint16_t>(y, x) - tolerance &&
          here <= farthest.at<std::uint16_t>(y, x) + tolerance)
        mask.at<std::uint8_t>(y, x) = 255;
    }
  return mask;
}

}  // namespace sediment::movers
