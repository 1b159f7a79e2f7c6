#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tools/render/colors.hpp"

namespace sediment::render {

/// Text with a thin halo of paper, left end of its base line at `at`. `size` 1 is about 12 pixels high.
void write_text(cv::Mat& picture, const std::string& text, cv::Point at, double size = 1,
                cv::Scalar bgr = {40, 40, 40});
cv::Size text_size(const std::string& text, double size = 1);

/// A title in the upper left corner.
void add_title(cv::Mat& picture, const std::string& title);

/// A bar of a round length in the lower left corner.
void add_scale_bar(cv::Mat& picture, double px_per_metre);

/// An entry of a legend.
struct LegendEntry {
  cv::Vec3b bgr;
  std::string text;
};

/// Swatches with names in the upper right corner.
void add_legend(cv::Mat& picture, const std::vector<LegendEntry>& entries);

/// The scale of heights in the lower right corner.
void add_height_scale(cv::Mat& picture, const HeightRange& range, const std::string& unit = "m");

}  // namespace sediment::render
