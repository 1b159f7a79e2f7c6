#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/pose.hpp"

namespace sediment::movers {

struct ContradictionParameters {
  double noise = 0.0014;     ///< deviation of a depth at 1 m; grows with the square of the depth
  double sigmas = 4;         ///< of that noise by which two depths may differ
  double slack_m = 0.03;     ///< for the poses, at any depth
  double slack_rad = 0.008;  ///< for the poses' rotation: reach of the window that must be clear as a whole
  /// Seconds between the instant that a pose is of and that at which a pixel was taken: sensors read row by
  /// row, and take depth and colour one after the other. Times the camera's speeds it adds to both slacks.
  double lag_s = 0.02;
  double min_depth_m = 0.4, max_depth_m = 4.5;
};

constexpr int kStep_px = 2;  ///< of the grid of pixels that are judged
/// That which stands for a cell of the grid.
inline cv::Point pixel_of(const cv::Point& cell) {
  return cell * kStep_px + cv::Point(kStep_px / 2, kStep_px / 2);
}

/// How fast the camera moves and turns.
struct Speed {
  double m_s = 0, rad_s = 0;
};

/// One look at the scene.
struct View {
  double stamp_s = 0;
  Pose world_from_camera;
  Speed speed;
  cv::Mat depth;    ///< CV_16UC1, 0 = no value
  cv::Mat dynamic;  ///< CV_8UC1; what moves there confirms nothing
};

/// Reaches of the windows, as multiples of slack_rad. A pair of views that needs a larger one says nothing.
constexpr std::array<int, 3> kReaches{1, 2, 4};

/// A view that others are compared with.
struct Reference {
  struct Window {
    cv::Mat farthest;  ///< of the static depths in the window around each pixel
    cv::Mat nearest;   ///< of all depths in it, 0 if a pixel has none
  };
  double stamp_s = 0;
  Pose camera_from_world;
  Speed speed;
  cv::Mat depth;  ///< CV_16UC1
  std::array<Window, kReaches.size()> windows;
};
Reference reference_of(const View& view, const Camera& camera, const ContradictionParameters& parameters);

/// What the references say of the pixels of a view, on the grid.
struct Verdicts {
  cv::Mat through;  ///< CV_8UC1: how many see through what the pixel shows: it was not there then
  cv::Mat hits;     ///< CV_8UC1: how many see it where it is
  cv::Mat beyond;   ///< CV_8UC1: how many see what lies behind it, but not all around
  cv::Mat lasting;  ///< CV_8UC1: 255 where more than a third of those that say anything see it, before and
                    ///< after; or where nothing was asked
};

/// Projects every pixel of the grid that has a depth into the references. One sees through it if every pixel
/// of the window around its image has a depth and all of them lie behind it by more than the tolerance
/// (the slack and `sigmas` deviations of both depths). One sees it if it does not, and the window's depths
/// reach from before it to behind it, or to within the tolerance of it, by static pixels. What is hidden, on
/// an edge or outside tells nothing. `rays` are those of the camera.
Verdicts verdicts_of(const View& view, std::span<const Reference* const> references, const Camera& camera,
                     const std::vector<Ray>& rays, const ContradictionParameters& parameters);

}  // namespace sediment::movers
