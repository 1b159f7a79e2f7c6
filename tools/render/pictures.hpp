#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tools/render/colors.hpp"
#include "tools/render/view.hpp"

namespace sediment::render {

/// What the pictures of clouds and octrees have in common.
struct MapOptions {
  ViewOptions view;
  ColorBy color = ColorBy::image;
  std::string ground, up;   ///< as in map_from_world()
  double max_height_m = 0;  ///< what is higher above the ground is cut off, to look into a room; 0 = nothing
  double point_size_m = 0;  ///< diameter; 0 = from the spacing of the points
  double shading = 2.2;     ///< strength of eye-dome lighting
  std::string title;
};

/// `path`: a `cloud` artifact or a PCD file.
cv::Mat cloud_picture(const std::filesystem::path& path, const MapOptions& options);

/// `folder`: an `octree` artifact. `max_depth`: of the leaves drawn, 16 = all.
cv::Mat octree_picture(const std::filesystem::path& folder, int max_depth, const MapOptions& options);

/// `folder`: a `grid-map` artifact. `width_px`: least size of the longer side.
cv::Mat grid_picture(const std::filesystem::path& folder, int least_px, const std::string& title);

struct MaskOptions {
  std::filesystem::path sequence, masks, dynamic;  ///< masks or dynamic may be empty
  std::vector<std::string> frames;                 ///< indices or stamps; empty: six spread over the sequence
  int columns = 3;
  std::string title;
};
cv::Mat mask_picture(const MaskOptions& options);

struct TrajectoryOptions {
  std::filesystem::path estimate,
      truth;  ///< folders of `trajectory` artifacts or files in TUM format; truth may be empty
  std::string up;
  double tolerance_s = 0.02;
  cv::Size size{1100, 900};
  std::string title;
};
/// Top view: the estimate, aligned rigidly with the truth and coloured by its distance from it.
cv::Mat trajectory_picture(const TrajectoryOptions& options);

}  // namespace sediment::render
