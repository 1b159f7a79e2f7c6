#pragma once

#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "stages/interaction-mask/contact.hpp"

namespace sediment::test {

/// A small picture of instances 1 .. count as overlapping ellipses, boxes, lines and speckle, and a depth
/// image with holes. Seeds cover touching, enclosed, distant and empty instances, all depth and no depth.
struct RandomScene {
  cv::Mat ids, depth;
  int count = 0;
};

inline RandomScene random_scene(unsigned seed) {
  std::mt19937 random(seed);
  const auto upto = [&](int most) { return static_cast<int>(random() % (most + 1)); };
  const int width = 1 + upto(47), height = 1 + upto(35);
  RandomScene scene{cv::Mat(height, width, CV_16UC1, cv::Scalar(0)), cv::Mat(height, width, CV_16UC1),
                    2 + upto(3)};
  for (int id = 1; id <= scene.count; ++id) {
    const int kind = upto(3), cx = upto(width), cy = upto(height), rx = 1 + upto(width / 2),
              ry = 1 + upto(height / 2);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double dx = static_cast<double>(x - cx) / rx, dy = static_cast<double>(y - cy) / ry;
        const bool inside = kind == 0   ? dx * dx + dy * dy <= 1
                            : kind == 1 ? std::abs(dx) <= 1 && std::abs(dy) <= 1
                            : kind == 2 ? std::abs(x - cx - (y - cy)) <= 1
                                        : random() % 5 == 0;
        if (inside) scene.ids.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(id);
      }
  }
  const int holes_percent = upto(4) * 25, spread = seed % 3 ? 3000 : 65535;
  for (auto& units : cv::Mat_<std::uint16_t>(scene.depth))
    units = upto(99) < holes_percent ? 0 : static_cast<std::uint16_t>(1 + random() % spread);
  return scene;
}

/// The published definition, word by word: all pixels of the one against all pixels of the other.
inline interaction_mask::ContactSum brute_force(const cv::Mat& ids, const cv::Mat& depth, int dynamic_id,
                                                int static_id, double radius_px) {
  std::vector<cv::Point> dynamic, fixed;
  for (int y = 0; y < ids.rows; ++y)
    for (int x = 0; x < ids.cols; ++x) {
      if (ids.at<std::uint16_t>(y, x) == dynamic_id) dynamic.emplace_back(x, y);
      if (ids.at<std::uint16_t>(y, x) == static_id) fixed.emplace_back(x, y);
    }
  interaction_mask::ContactSum sum;
  for (const cv::Point a : dynamic)
    for (const cv::Point b : fixed) {
      if ((a - b).dot(a - b) > radius_px * radius_px) continue;
      const int depth_a = depth.at<std::uint16_t>(a), depth_b = depth.at<std::uint16_t>(b);
      if (depth_a == 0 || depth_b == 0) continue;
      ++sum.pixel_pairs;
      sum.depth_difference += static_cast<std::uint64_t>(std::abs(depth_a - depth_b));
    }
  return sum;
}

}  // namespace sediment::test
