#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "pipeline/scene/frame.hpp"
#include "pipeline/scene/labels.hpp"

namespace sediment::interaction_mask {

struct TouchParameters {
  double radius_px = 6;      ///< reach of a pixel pair in the image; 6 in the paper
  double threshold_m = 0.3;  ///< interacting below this mean depth difference; the paper does not give it
  int min_pairs = 1;         ///< fewer pairs than these decide nothing; the paper has no minimum
  std::vector<std::string> immovable{"wall", "floor", "ceiling"};  ///< classes that no touch sets in motion
};

/// The test of one pair: A prior dynamic, B prior static.
struct PairTest {
  int dynamic_id = 0, static_id = 0;
  std::uint64_t pixel_pairs = 0;       ///< N
  double mean_depth_difference_m = 0;  ///< 0 if there is no pair
  bool interacting = false;
};

/// What the test says of one frame.
struct TouchedFrame {
  std::vector<int> prior_dynamic_ids;
  std::vector<PairTest> pairs;  ///< pairs that come within the radius with depth, by dynamic then static id
  std::set<int> touched_ids;    ///< prior static ones that interact with some prior dynamic one
  std::vector<std::string>
      unlisted;  ///< classes of instances that the label table does not know, as they come
};

/// Section 3.2 of the paper for one frame. An instance is prior dynamic if the table says so of its class; a
/// class that the table does not know is prior static. `depth` is CV_16UC1 in `depth_scale` units per metre,
/// of the mask's size. Throws std::invalid_argument if sizes differ.
TouchedFrame find_touched(const InstanceMask& mask, const cv::Mat& depth, double depth_scale,
                          const LabelTable& labels, const TouchParameters& parameters);

/// The dynamic mask (CV_8UC1 of DynamicValue): prior dynamic ids, and the ids of what they move.
cv::Mat paint_dynamic(const cv::Mat& ids, const std::vector<int>& prior_dynamic_ids,
                      const std::set<int>& moved_ids);

}  // namespace sediment::interaction_mask
