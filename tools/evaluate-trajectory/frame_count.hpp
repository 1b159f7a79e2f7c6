#pragma once

#include <filesystem>
#include <optional>

#include "tools/evaluate-trajectory/evaluation.hpp"

namespace sediment::tools {

/// Number of images that a list (rgb.txt) names. Throws std::runtime_error with file and line.
FrameCount frames_of_list(const std::filesystem::path& list);

/// What is known without being told: tracking.json beside the estimate, else rgb.txt beside the truth.
std::optional<FrameCount> known_frames(const std::filesystem::path& truth,
                                       const std::filesystem::path& estimate);

}  // namespace sediment::tools
