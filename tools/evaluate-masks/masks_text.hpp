#pragma once

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core.hpp>
#include <string>

#include "tools/evaluate-masks/dynamic_evaluation.hpp"
#include "tools/evaluate-masks/instance_evaluation.hpp"

namespace sediment::tools {

/// Tables for people.
std::string to_text(const DynamicEvaluation& evaluation);
std::string to_text(const InstanceEvaluation& evaluation);

/// iou, precision, recall, boundary_f, missed_frames, frames..., by class and frame by frame. A figure that
/// has nothing to be computed from is null.
nlohmann::ordered_json to_json(const DynamicEvaluation& evaluation);
nlohmann::ordered_json to_json(const InstanceEvaluation& evaluation);

/// Figures over time.
cv::Mat plot(const DynamicEvaluation& evaluation);

}  // namespace sediment::tools
