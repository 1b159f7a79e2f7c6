#include "tools/evaluate-map/label_score.hpp"

#include <algorithm>

namespace sediment::tools {
namespace {

constexpr std::uint32_t kCocoClasses = 80;

}  // namespace

std::optional<double> LabelScore::mean_iou() const {
  if (classes.empty()) return std::nullopt;
  double sum = 0;
  for (const auto& [label, pixels] : classes) sum += pixels.iou();
  return sum / static_cast<double>(classes.size());
}

LabelScore label_score(const LabelledCloud& map, const std::vector<NearestPoint::Found>& nearest,
                       const LabelledCloud& truth, double threshold_m, std::size_t least_points) {
  LabelScore score;
  bool has_labels = false, knows_rooms = false;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const std::uint32_t label = map[i].label;
    has_labels = has_labels || label != kUnlabelled;
    if (nearest[i].distance_m > threshold_m || nearest[i].point_idx >= truth.size()) continue;
    const std::uint32_t true_label = truth[nearest[i].point_idx].label;
    knows_rooms = knows_rooms || (label >= kCocoClasses && label != kUnlabelled);
    if (label == true_label) {
      ++score.classes[label].both;
    } else {
      ++score.classes[label].only_map;
      ++score.classes[true_label].only_truth;
    }
  }
  if (!has_labels) return {};
  std::erase_if(score.classes, [&](const auto& entry) {
    const auto& [label, pixels] = entry;
    return label == kUnlabelled || (label >= kCocoClasses && !knows_rooms) ||
           pixels.both + pixels.only_truth < std::max<std::size_t>(1, least_points);
  });
  return score;
}

}  // namespace sediment::tools
