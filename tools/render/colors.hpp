#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "pipeline/scene/labelled_point.hpp"
#include "pipeline/scene/vec3.hpp"

namespace sediment::render {

/// What colours show.
enum class ColorBy { image, label, height };

/// The class's colour, softened towards the brightness of the image so that shapes show; unlabelled is grey.
cv::Vec3b label_color(std::uint32_t label, cv::Vec3b image_bgr, const LabelTable& labels);

/// Colour of a value between 0 and 1 on the scale of heights (OpenCV's turbo).
cv::Vec3b scale_color(double share);

/// The lowest and highest of all heights but the outermost half percent.
struct HeightRange {
  double low_m = 0, high_m = 1;
  double share(double height_m) const;
};
HeightRange height_range(std::span<const double> heights_m);

}  // namespace sediment::render
