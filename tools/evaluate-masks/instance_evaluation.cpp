#include "tools/evaluate-masks/instance_evaluation.hpp"

#include <set>
#include <stdexcept>

#include "pipeline/artifacts/label_file.hpp"

namespace sediment::tools {
namespace {

constexpr double kLeastIou = 0.5;
constexpr std::uint32_t kCocoClasses = 80;

/// Pixels of the true and the found instances of a frame, and of every pair that meets.
struct Areas {
  std::map<int, std::uint64_t> truth, found;
  std::map<std::pair<int, int>, std::uint64_t> both;
};

Areas areas_of(const cv::Mat& truth, const cv::Mat& found) {
  Areas areas;
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols;) {
      const int true_id = truth.at<std::uint16_t>(y, x), found_id = found.at<std::uint16_t>(y, x);
      const int from = x;
      while (x < truth.cols && truth.at<std::uint16_t>(y, x) == true_id &&
             found.at<std::uint16_t>(y, x) == found_id)
        ++x;
      const auto run = static_cast<std::uint64_t>(x - from);
      if (true_id != 0) areas.truth[true_id] += run;
      if (found_id != 0) areas.found[found_id] += run;
      if (true_id != 0 && found_id != 0) areas.both[{true_id, found_id}] += run;
    }
  return areas;
}

bool is_asked_for(const std::string& class_name) {
  const Label* label = default_labels().find(class_name);
  return label != nullptr && label->id < kCocoClasses;
}

/// Adds one frame; `last_match` is by true id.
void add_frame(InstanceEvaluation& evaluation, const InstanceTruth& truth, const cv::Mat& true_ids,
               const InstanceMask& found, std::uint64_t least_pixels, std::map<int, int>& last_match) {
  const Areas areas = areas_of(true_ids, found.ids);
  std::map<int, std::string> found_class;
  for (const Instance& instance : found.instances) found_class[instance.id] = instance.class_name;
  std::set<int> too_small;  // found instances that match a true one nobody is asked for
  for (const auto& [pair, both] : areas.both) {
    const auto& [true_id, found_id] = pair;
    const std::uint64_t true_area = areas.truth.at(true_id);
    const double iou =
        static_cast<double>(both) / static_cast<double>(true_area + areas.found.at(found_id) - both);
    const std::string name = truth.class_of(true_id);
    if (iou < kLeastIou || name != found_class[found_id]) continue;
    if (true_area < least_pixels) {
      too_small.insert(found_id);
      continue;
    }
    ClassInstances& of = evaluation.classes[name];
    ++of.matched;
    of.iou_sum += iou;
    const auto [before, fresh] = last_match.try_emplace(true_id, found_id);
    if (!fresh && before->second != found_id) ++of.switches;
    before->second = found_id;
  }
  for (const auto& [id, area] : areas.truth)
    if (area >= least_pixels && is_asked_for(truth.class_of(id)))
      ++evaluation.classes[truth.class_of(id)].truth;
  for (const Instance& instance : found.instances)
    if (!too_small.contains(instance.id)) ++evaluation.classes[instance.class_name].found;
}

}  // namespace

InstanceEvaluation evaluate_instances(const InstanceTruth& truth, const MasksReader& found,
                                      const std::vector<std::string>& truth_stamps, int least_pixels) {
  InstanceEvaluation evaluation;
  evaluation.truth_frames = truth_stamps.size();
  std::map<int, int> last_match;
  for (const std::string& stamp : truth_stamps) {
    if (!found.has(stamp)) continue;
    const cv::Mat true_ids = truth.ids(stamp);
    const InstanceMask mask = found.read(stamp);
    if (true_ids.size() != mask.ids.size())
      throw std::runtime_error("frame " + stamp + ": truth and masks are of different sizes");
    add_frame(evaluation, truth, true_ids, mask, static_cast<std::uint64_t>(least_pixels), last_match);
    ++evaluation.frames;
  }
  if (evaluation.frames == 0) throw std::runtime_error("no frame has both true and found instances");
  return evaluation;
}

}  // namespace sediment::tools
