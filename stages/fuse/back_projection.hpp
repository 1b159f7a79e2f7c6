#pragma once

#include <cstdint>
#include <span>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/frame.hpp"
#include "pipeline/scene/labelled_point.hpp"
#include "pipeline/scene/pose.hpp"

namespace sediment::fuse {

/// What becomes of a pixel.
struct Projection {
  double min_depth_m = 0.4;  ///< nearer, structured-light sensors give no or wrong depth
  double max_depth_m = 5.0;  ///< noise grows with the square: about 4 cm here
  int pixel_step = 2;        ///< every n-th column of every n-th row
  double blend = 0.5;        ///< share of the class colour in a labelled point's colour
  /// Pixels whose depth differs from that of a neighbour (of 4) by more than a surface seen at this angle to
  /// its normal can explain, three deviations of the noise allowed, are left out: at edges the sensor mixes
  /// depths, and at grazing angles it errs. 90 keeps all.
  double max_incidence_deg = 90;
  double noise = 0.0014;  ///< deviation of a depth at 1 m; grows with the square of the depth
};

/// The images of one frame. All have the camera's size.
struct View {
  cv::Mat color;      ///< CV_8UC3, BGR
  cv::Mat depth;      ///< CV_16UC1
  InstanceMask mask;  ///< ids may be empty: nothing is labelled
  cv::Mat dynamic;    ///< CV_8UC1 of DynamicValue; may be empty: everything is static
  Pose world_from_camera;
};

/// What happened to the pixels visited.
struct PixelCounts {
  std::uint64_t visited = 0, dynamic = 0;
  std::uint64_t out_of_range = 0;  ///< no depth, too near or too far
  std::uint64_t at_edge = 0;       ///< or seen at too grazing an angle
  PixelCounts& operator+=(const PixelCounts& other);
};

/// Appends the static pixels of one frame to `cloud`, in the world frame, row by row: equation (8) of the
/// paper, p_world = R * (depth * ray) + T, with `rays` of the camera (rays_of: lens undone). Points are
/// finite. Colour, label and instance come from the instance mask; a class that the table does not know
/// leaves the point unlabelled and in the image's colour. Throws std::invalid_argument if an image is not of
/// the camera's size.
PixelCounts back_project(const View& view, const Camera& camera, std::span<const Ray> rays,
                         const LabelTable& labels, const Projection& projection, LabelledCloud& cloud);

}  // namespace sediment::fuse
