#include "tools/evaluate-masks/dynamic_evaluation.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

#include "pipeline/scene/frame.hpp"

namespace sediment::tools {
namespace {

std::string size_text(const cv::Mat& image) {
  return std::to_string(image.cols) + " x " + std::to_string(image.rows);
}

void require_same_size(const cv::Mat& truth, const cv::Mat& other, const std::string& stamp,
                       const char* what) {
  if (truth.size() != other.size())
    throw std::runtime_error("frame " + stamp + ": the truth has " + size_text(truth) + " pixels, " + what +
                             " " + size_text(other));
}

/// Dynamic and static pixels of one instance.
struct InstancePixels {
  std::uint64_t dynamic = 0, dynamic_masked = 0, still = 0, still_masked = 0;
};

std::vector<InstancePixels> count_by_id(const cv::Mat& ids, const cv::Mat& truth, const cv::Mat& mask) {
  std::vector<InstancePixels> counts(65536);
  for (int y = 0; y < ids.rows; ++y) {
    const auto* id_row = ids.ptr<std::uint16_t>(y);
    const auto *true_row = truth.ptr<std::uint8_t>(y), *row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < ids.cols; ++x) {
      InstancePixels& of = counts[id_row[x]];
      ++(true_row[x] != 0 ? of.dynamic : of.still);
      if (row[x] != 0) ++(true_row[x] != 0 ? of.dynamic_masked : of.still_masked);
    }
  }
  return counts;
}

void judge_mover(FrameMasks& frame, const std::string& name, std::uint64_t pixels, std::uint64_t hit,
                 const MissRule& rule) {
  const double share = static_cast<double>(pixels) / static_cast<double>(frame.overlap.pixels());
  if (share <= rule.visible_share) return;
  frame.has_visible_mover = true;
  const double recall = static_cast<double>(hit) / static_cast<double>(pixels);
  if (recall < rule.least_recall) frame.missed.push_back({name, share, recall});
}

void add_instances(FrameMasks& frame, const InstanceTruth& instances, const cv::Mat& truth,
                   const cv::Mat& mask, const MissRule& rule) {
  const cv::Mat ids = instances.ids(frame.stamp);
  require_same_size(truth, ids, frame.stamp, "its instances");
  const auto counts = count_by_id(ids, truth, mask);
  for (int id = 0; id < 65536; ++id) {
    const InstancePixels& of = counts[static_cast<std::size_t>(id)];
    if (of.dynamic + of.still == 0) continue;
    const std::string name = id == 0 ? "(nothing)" : instances.class_of(id);
    ClassPixels& by_class = frame.classes[name.empty() ? "(unknown)" : name];
    by_class.dynamic += of.dynamic;
    by_class.dynamic_masked += of.dynamic_masked;
    by_class.still += of.still;
    by_class.still_masked += of.still_masked;
    judge_mover(frame, name + " " + std::to_string(id), of.dynamic, of.dynamic_masked, rule);
  }
}

FrameMasks evaluate_frame(const std::string& stamp, const MaskFolder& truth_folder,
                          const MaskFolder& mask_folder, const std::optional<InstanceTruth>& instances,
                          const MissRule& rule) {
  const cv::Mat truth = truth_folder.dynamic(stamp), mask = mask_folder.dynamic(stamp);
  require_same_size(truth, mask, stamp, "the mask");
  FrameMasks frame;
  frame.stamp = stamp;
  frame.overlap = overlap_of(truth, mask);
  frame.boundary_f = boundary_f(truth, mask, boundary_radius_px(truth.size()));
  const cv::Mat masked = mask != 0;
  const auto count = [&](int value, std::uint64_t& pixels, std::uint64_t& hit) {
    const cv::Mat of_value = truth == value;
    pixels = static_cast<std::uint64_t>(cv::countNonZero(of_value));
    hit = static_cast<std::uint64_t>(cv::countNonZero(of_value & masked));
  };
  count(kPriorDynamic, frame.prior, frame.prior_hit);
  count(kNonPriorDynamic, frame.non_prior, frame.non_prior_hit);
  if (instances)
    add_instances(frame, *instances, truth, mask, rule);
  else
    judge_mover(frame, "movers", frame.overlap.hit + frame.overlap.missed, frame.overlap.hit, rule);
  return frame;
}

}  // namespace

Overlap DynamicEvaluation::total() const {
  Overlap sum;
  for (const FrameMasks& frame : frames) sum += frame.overlap;
  return sum;
}

std::map<std::string, ClassPixels> DynamicEvaluation::classes() const {
  std::map<std::string, ClassPixels> sums;
  for (const FrameMasks& frame : frames)
    for (const auto& [name, pixels] : frame.classes) {
      ClassPixels& sum = sums[name];
      sum.dynamic += pixels.dynamic;
      sum.dynamic_masked += pixels.dynamic_masked;
      sum.still += pixels.still;
      sum.still_masked += pixels.still_masked;
    }
  return sums;
}

std::size_t DynamicEvaluation::frames_with_mover() const {
  return static_cast<std::size_t>(
      std::count_if(frames.begin(), frames.end(), [](const FrameMasks& f) { return f.has_visible_mover; }));
}

std::size_t DynamicEvaluation::missed_frames() const {
  return static_cast<std::size_t>(
      std::count_if(frames.begin(), frames.end(), [](const FrameMasks& f) { return !f.missed.empty(); }));
}

DynamicEvaluation evaluate_dynamic(const MaskFolder& truth, const MaskFolder& masks,
                                   const std::optional<InstanceTruth>& instances, const MissRule& rule) {
  std::vector<std::string> common;
  for (const std::string& stamp : truth.stamps())
    if (masks.has(stamp)) common.push_back(stamp);
  if (common.empty())
    throw std::runtime_error("no frame has both truth (" + truth.file_of(truth.stamps().front()).string() +
                             ", ...) and mask (" + masks.file_of(masks.stamps().front()).string() + ", ...)");
  DynamicEvaluation evaluation;
  evaluation.truth_frames = truth.stamps().size();
  evaluation.mask_frames = masks.stamps().size();
  evaluation.by_instance = instances.has_value();
  evaluation.frames.resize(common.size());
  tbb::parallel_for(std::size_t{0}, common.size(), [&](std::size_t i) {
    evaluation.frames[i] = evaluate_frame(common[i], truth, masks, instances, rule);
  });
  return evaluation;
}

}  // namespace sediment::tools
