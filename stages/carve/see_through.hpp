#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/labelled_point.hpp"
#include "pipeline/scene/pose.hpp"
#include "stages/carve/point_blocks.hpp"

namespace sediment::carve {

struct Parameters {
  double noise = 0.0014;  ///< deviation of a depth at 1 m; grows with the square of the depth
  double sigmas = 4;      ///< of that noise which a depth may be off
  double slack_m = 0.02;  ///< for the poses, at any depth
  double min_depth_m = 0.4, max_depth_m = 5;
  int window_px = 2;       ///< reach of the window that must be seen through as a whole
  int min_views = 3;       ///< that see through a point, for it to go
  double min_share = 0.5;  ///< of the views that tell something about a point
  /// A point stays only if at least this share of the views in which its very pixel shows it, or something
  /// behind it, show it: what sensors see in the air beside an edge is elsewhere in the next view.
  double min_confirmed = 0.2;
  /// A point goes if more than this share of the views whose very pixel shows it take it for a person: where
  /// a network is of two minds, the map keeps people out.
  double max_person_share = 0.25;
  bool settle = false;  ///< move points to where the views that see them have them in the mean
};

/// One look at the scene.
struct DepthView {
  Pose camera_from_world;
  cv::Mat depth;    ///< CV_16UC1, 0 = no value
  cv::Mat dynamic;  ///< CV_8UC1 or empty; other than 0: what is there tells nothing about what stays
};

/// What the views say about one point.
struct Votes {
  std::uint16_t through = 0;  ///< views that see through it
  std::uint16_t hits = 0;     ///< views that see it
  std::uint16_t behind = 0;   ///< other views whose very pixel shows something behind it: maybe an edge
  std::uint16_t person = 0;   ///< views whose very pixel shows it, and takes it for a person
  std::uint16_t shown = 0;    ///< views whose very pixel shows it, static: they say where it is
  float weight = 0;           ///< sum of those views' weights: the inverse of the noise's variance, 1/m^2
  float x = 0, y = 0, z = 0;  ///< weighted sum of the ways to where they have it, world, metres
};

/// Adds a view's votes, one entry of `votes` for each of `cloud.points`. A view sees a point if some static
/// depth of the window around its image is that of the point within the tolerance; it sees through it if
/// every pixel of the window has a depth, and all of them lie behind the point by more than the tolerance. So
/// a point at an edge, on a surface seen at a grazing angle or where the sensor says nothing is never seen
/// through. In parallel; votes do not depend on it.
///
/// The pixel on which the point's image falls shows the point if its depth is that of the point within the
/// tolerance. It says whether a person is there or, if it is static, where the point is: on its ray, at the
/// depth measured.
void add_votes(const PointBlocks& cloud, const Camera& camera, const DepthView& view,
               const Parameters& parameters, std::vector<Votes>& votes);

/// Whether the point goes.
bool is_carved(const Votes& votes, const Parameters& parameters);

/// The point where the views have it in the weighted mean; as it is if fewer than `min_views` say so.
LabelledPoint settled(LabelledPoint point, const Votes& votes, const Parameters& parameters);

}  // namespace sediment::carve
