#include "stages/interaction-mask/dynamic_mask.hpp"

#include <algorithm>
#include <stdexcept>

#include "stages/interaction-mask/contact.hpp"

namespace sediment::interaction_mask {
namespace {

/// Ids by what is known of their class beforehand (table 1 of the paper).
struct Prior {
  std::vector<int> dynamic_ids, static_ids;  ///< static: only those that a touch can set in motion
};

Prior prior_of(const InstanceMask& mask, const LabelTable& labels, const TouchParameters& parameters,
               std::vector<std::string>& unlisted) {
  Prior prior;
  for (const Instance& instance : mask.instances) {
    const Label* label = labels.find(instance.class_name);
    if (!label) unlisted.push_back(instance.class_name);
    const auto& immovable = parameters.immovable;
    if (label && label->prior_dynamic)
      prior.dynamic_ids.push_back(instance.id);
    else if (std::find(immovable.begin(), immovable.end(), instance.class_name) == immovable.end())
      prior.static_ids.push_back(instance.id);
  }
  return prior;
}

/// Steps 3 and 4 of section 3.2.
PairTest decide(int dynamic_id, int static_id, const ContactSum& sum, double depth_scale,
                const TouchParameters& parameters) {
  PairTest test{dynamic_id, static_id, sum.pixel_pairs};
  if (sum.pixel_pairs == 0) return test;
  test.mean_depth_difference_m =
      static_cast<double>(sum.depth_difference) / static_cast<double>(sum.pixel_pairs) / depth_scale;
  test.interacting = sum.pixel_pairs >= static_cast<std::uint64_t>(parameters.min_pairs) &&
                     test.mean_depth_difference_m < parameters.threshold_m;
  return test;
}

}  // namespace

TouchedFrame find_touched(const InstanceMask& mask, const cv::Mat& depth, double depth_scale,
                          const LabelTable& labels, const TouchParameters& parameters) {
  if (mask.ids.size() != depth.size())
    throw std::invalid_argument("the mask is " + std::to_string(mask.ids.cols) + "x" +
                                std::to_string(mask.ids.rows) + ", the depth image " +
                                std::to_string(depth.cols) + "x" + std::to_string(depth.rows));
  TouchedFrame frame;
  const Prior prior = prior_of(mask, labels, parameters, frame.unlisted);
  frame.prior_dynamic_ids = prior.dynamic_ids;
  const std::vector<ContactSum> sums =
      contact_sums(mask.ids, depth, prior.dynamic_ids, prior.static_ids, parameters.radius_px);
  auto sum = sums.begin();
  for (const int dynamic_id : prior.dynamic_ids)
    for (const int static_id : prior.static_ids) {
      const PairTest test = decide(dynamic_id, static_id, *sum++, depth_scale, parameters);
      if (test.pixel_pairs > 0) frame.pairs.push_back(test);
      if (test.interacting) frame.touched_ids.insert(static_id);
    }
  return frame;
}

cv::Mat paint_dynamic(const cv::Mat& ids, const std::vector<int>& prior_dynamic_ids,
                      const std::set<int>& moved_ids) {
  std::vector<std::uint8_t> value_of_id(65536, kStatic);
  for (const int id : moved_ids) value_of_id[static_cast<std::size_t>(id)] = kNonPriorDynamic;
  for (const int id : prior_dynamic_ids) value_of_id[static_cast<std::size_t>(id)] = kPriorDynamic;
  cv::Mat painted(ids.size(), CV_8UC1);
  for (int y = 0; y < ids.rows; ++y) {
    const auto* from = ids.ptr<std::uint16_t>(y);
    auto* to = painted.ptr<std::uint8_t>(y);
    for (int x = 0; x < ids.cols; ++x) to[x] = value_of_id[from[x]];
  }
  return painted;
}

}  // namespace sediment::interaction_mask
