#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/scene/frame.hpp"
#include "pipeline/scene/labels.hpp"

namespace sediment::interaction_mask {

struct Parameters {
  double radius_px = 6;       ///< reach of a pixel pair in the image; 6 in the paper
  double threshold_m = 0.3;  ///< interacting below this mean depth difference; the paper does not give it
  int min_pairs = 1;          ///< fewer pairs than these decide nothing; the paper has no minimum
  std::vector<std::string> immovable{"wall", "floor", "ceiling"};  ///< classes that no touch sets in motion
};

/// The test of one pair: A prior dynamic, B prior static.
struct PairTest {
  int dynamic_id = 0, static_id = 0;
  std::uint64_t pixel_pairs = 0;       ///< N
  double mean_depth_difference_m = 0;  ///< 0 if there is no pair
  bool interacting = false;
};

/// One frame, classified.
struct ClassifiedFrame {
  cv::Mat dynamic;              ///< CV_8UC1 of DynamicValue
  std::vector<PairTest> pairs;  ///< pairs that come within the radius with depth, by dynamic then static id
  int prior_dynamic = 0;        ///< instances
  int non_prior_dynamic = 0;    ///< instances
  std::uint64_t dynamic_pixels = 0;  ///< of both kinds
  std::vector<std::string>
      unlisted;  ///< classes of instances that the label table does not know, as they come
};

/// Section 3.2 of the paper for one frame: instances of prior dynamic classes become kPriorDynamic, those of
/// other classes that interact with one of them kNonPriorDynamic. A class that the table does not know is
/// prior static. `depth` is CV_16UC1 in `depth_scale` units per metre, of the mask's size. Throws
/// std::invalid_argument if sizes differ.
ClassifiedFrame classify(const InstanceMask& mask, const cv::Mat& depth, double depth_scale,
                         const LabelTable& labels, const Parameters& parameters);

}  // namespace sediment::interaction_mask
