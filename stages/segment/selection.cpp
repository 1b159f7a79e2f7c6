#include "stages/segment/selection.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include "pipeline/contract/errors.hpp"
#include "pipeline/contract/nearest_name.hpp"

namespace sediment::segment {
namespace {

std::size_t find_class(const std::string& parameter, const std::string& name,
                       const std::vector<std::string>& class_names) {
  const auto found = std::ranges::find(class_names, name);
  if (found != class_names.end()) return static_cast<std::size_t>(found - class_names.begin());
  const std::string nearest = contract::nearest_name(name, class_names);
  throw contract::UsageError(parameter + ": the network has no class \"" + name + "\"" +
                             (nearest.empty() ? "" : ", did you mean \"" + nearest + "\"?"));
}

/// "person=0.1" -> person, 0.1.
std::pair<std::string, float> parse_confidence(const std::string& entry) {
  const std::size_t sign = entry.rfind('=');
  float confidence = -1;
  if (sign != std::string::npos) {
    const char *from = entry.data() + sign + 1, *end = entry.data() + entry.size();
    if (const auto [stop, error] = std::from_chars(from, end, confidence);
        error != std::errc() || stop != end)
      confidence = -1;
  }
  if (!(confidence >= 0 && confidence <= 1))
    throw contract::UsageError("class_confidence: expected CLASS=NUMBER with a number in 0 .. 1, found \"" +
                               entry + "\"");
  return {entry.substr(0, sign), confidence};
}

}  // namespace

Selection select(const Parameters& parameters, const std::vector<std::string>& class_names) {
  Selection selection;
  selection.iou = static_cast<float>(parameters.iou);
  selection.max_detections = static_cast<std::size_t>(parameters.max_detections);
  selection.confidence.assign(class_names.size(), static_cast<float>(parameters.confidence));
  for (const std::string& entry : parameters.class_confidence) {
    const auto [name, confidence] = parse_confidence(entry);
    selection.confidence[find_class("class_confidence", name, class_names)] = confidence;
  }
  if (parameters.classes.empty()) return selection;
  std::vector<float> wanted(class_names.size(), std::numeric_limits<float>::infinity());
  for (const std::string& name : parameters.classes) {
    const std::size_t class_idx = find_class("classes", name, class_names);
    wanted[class_idx] = selection.confidence[class_idx];
  }
  selection.confidence = std::move(wanted);
  return selection;
}

}  // namespace sediment::segment
