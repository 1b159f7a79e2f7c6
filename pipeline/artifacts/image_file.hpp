#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace sediment {

/// What the header of an image file says.
struct ImageHeader {
  int width = 0, height = 0;
  int bits = 0;      ///< per channel
  int channels = 0;  ///< PNG palette images count as 3
};

/// Reads the header of a PNG or JPEG file and checks that its end is there (PNG's IEND chunk, JPEG's EOI
/// marker). Throws std::runtime_error that names the file: missing, not an image, truncated.
ImageHeader probe_image(const std::filesystem::path& file);

/// Decodes to CV_8UC3 BGR. Throws std::runtime_error that names the file.
cv::Mat read_color(const std::filesystem::path& file);
/// Decodes a single-channel 16-bit PNG to CV_16UC1 (depth, instance ids). Throws as above, also for 8 bits.
cv::Mat read_gray16(const std::filesystem::path& file);
/// Decodes a single-channel 8-bit PNG to CV_8UC1. Throws as above.
cv::Mat read_gray8(const std::filesystem::path& file);

/// Writes CV_8UC1, CV_8UC3 or CV_16UC1 as PNG with a fixed, fast compression (equal bytes for equal images).
/// Throws std::runtime_error that names the file, also if the disk is full.
void write_png(const std::filesystem::path& file, const cv::Mat& image);

}  // namespace sediment
