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

Prior prior_of(const InstanceMask& mask, const LabelTable& labels, const Parameters& parameters,
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
                const Parameters& parameters) {
  PairTest test{dynamic_id, static_id, sum.pixel_pairs};
  if (sum.pixel_pairs == 0) return test;
  test.mean_depth_difference_m =
      static_cast<double>(sum.depth_difference) / static_cast<double>(sum.pixel_pairs) / depth_scale;
  test.interacting = sum.pixel_pairs >= static_cast<std::uint64_t>(parameters.min_pairs) &&
                     test.mean_depth_difference_m < parameters.threshold_m;
  return test;
}

/// Paints each pixel with the value of its id.
cv::Mat paint(const cv::Mat& ids, const std::vector<std::uint8_t>& value_of_id) {
  cv::Mat painted(ids.size(), CV_8UC1);
  for (int y = 0; y < ids.rows; ++y) {
    const auto* from = ids.ptr<std::uint16_t>(y);
    auto* to = painted.ptr<std::uint8_t>(y);
    for (int x = 0; x < ids.cols; ++x)
      to[x] = from[x] < value_of_id.size() ? value_of_id[from[x]] : std::uint8_t{kStatic};
  }
  return painted;
}

}  // namespace

ClassifiedFrame classify(const InstanceMask& mask, const cv::Mat& depth, double depth_scale,
                         const LabelTable& labels, const Parameters& parameters) {
  if (mask.ids.size() != depth.size())
    throw std::invalid_argument("the mask is " + std::to_string(mask.ids.cols) + "x" +
                                std::to_string(mask.ids.rows) + ", the depth image " +
                                std::to_string(depth.cols) + "x" + std::to_string(depth.rows));
  ClassifiedFrame frame;
  const Prior prior = prior_of(mask, labels, parameters, frame.unlisted);
  const std::vector<ContactSum> sums =
      contact_sums(mask.ids, depth, prior.dynamic_ids, prior.static_ids, parameters.radius_px);

  std::vector<std::uint8_t> value_of_id(1, kStatic);
  const auto mark = [&](int id, DynamicValue value) {
    value_of_id.resize(std::max(value_of_id.size(), static_cast<std::size_t>(id) + 1), kStatic);
    if (value == kNonPriorDynamic && value_of_id[id] == kStatic) ++frame.non_prior_dynamic;
    value_of_id[id] = value;
  };
  auto sum = sums.begin();
  for (const int dynamic_id : prior.dynamic_ids) {
    mark(dynamic_id, kPriorDynamic);
    for (const int static_id : prior.static_ids) {
      const PairTest test = decide(dynamic_id, static_id, *sum++, depth_scale, parameters);
      if (test.pixel_pairs > 0) frame.pairs.push_back(test);
      if (test.interacting) mark(static_id, kNonPriorDynamic);
    }
  }
  frame.prior_dynamic = static_cast<int>(prior.dynamic_ids.size());
  frame.dynamic = paint(mask.ids, value_of_id);
  frame.dynamic_pixels = static_cast<std::uint64_t>(cv::countNonZero(frame.dynamic));
  return frame;
}

}  // namespace sediment::interaction_mask
