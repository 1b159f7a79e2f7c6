#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace sediment::render {

/// Writes a picture for people, small rather than quick: PNG, or JPEG for a photograph-like view on a page,
/// by the file's extension. Throws std::runtime_error that names the file, also for another extension.
void write_picture(const std::filesystem::path& file, const cv::Mat& bgr);

}  // namespace sediment::render
