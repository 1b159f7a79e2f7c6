#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "tools/render/view.hpp"

namespace sediment::render {

/// A picture with a depth for each pixel, twice as fine as the picture that comes out.
class Canvas {
 public:
  explicit Canvas(const View& view);

  /// A disc that faces the camera.
  void disc(Vec3 center, double radius_m, cv::Vec3b bgr);
  /// A cube; its visible faces are lit from above. `up` is a direction in the world.
  void cube(Vec3 center, double side_m, cv::Vec3b bgr, Vec3 up);

  /// Darkens what lies behind its surroundings (eye-dome lighting, Boucheny 2009), which shows shape where
  /// there are no normals, and scales down to the size of the view.
  cv::Mat shaded(double strength) const;

 private:
  void triangle(const std::array<Projected, 3>& corners, cv::Vec3b bgr);

  View view_;  ///< of the fine picture
  cv::Mat color_, depth_;
};

/// The colour of paper behind everything.
inline const cv::Vec3b kPaper{250, 250, 250};

}  // namespace sediment::render
