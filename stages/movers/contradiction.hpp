#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/pose.hpp"

namespace sediment::movers {

struct ContradictionParameters {
  double noise = 0.0014;     ///< deviation of a depth at 1 m; grows with the square of the depth
  double sigmas = 4;         ///< of that noise by which two depths may differ
  double slack_m = 0.03;     ///< for the poses, at any depth
  double slack_rad = 0.008;  ///< for the poses' rotation and the shutter: the window that must be clear
  double min_depth_m = 0.4, max_depth_m = 4.5;
};

constexpr int kStep_px = 2;  ///< of the grid of pixels that are judged

/// One look at the scene.
struct View {
  Pose world_from_camera;
  cv::Mat depth;    ///< CV_16UC1, 0 = no value
  cv::Mat dynamic;  ///< CV_8UC1; what moves there confirms nothing
};

/// A view that others are compared with.
struct Reference {
  Pose camera_from_world;
  cv::Mat depth;     ///< CV_16UC1
  cv::Mat farthest;  ///< of the static depths in the window around each pixel
  cv::Mat nearest;   ///< of all depths in it, 0 if a pixel has none
};
Reference reference_of(const View& view, const Camera& camera, const ContradictionParameters& parameters);

/// What the references say of the pixels of a view, on the grid.
struct Verdicts {
  cv::Mat through;  ///< CV_8UC1: how many see through what the pixel shows: it was not there then
  cv::Mat hits;     ///< CV_8UC1: how many see it where it is
};

/// Projects every pixel of the grid that has a depth into the references. One sees through it if every pixel
/// of the window around its image has a depth and all of them lie behind it by more than the tolerance
/// (`slack_m` and `sigmas` deviations of both depths). One sees it if it does not, and the window's depths
/// reach from before it to behind it, or to within the tolerance of it, by static pixels. What is hidden, on
/// an edge or outside tells nothing. `rays` are those of the camera.
Verdicts verdicts_of(const View& view, std::span<const Reference* const> references, const Camera& camera,
                     const std::vector<Ray>& rays, const ContradictionParameters& parameters);

}  // namespace sediment::movers
