#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>

#include "pipeline/scene/pose.hpp"

namespace sediment::render {

/// Where a point falls in the picture.
struct Projected {
  float u = 0, v = 0;      ///< pixels
  float depth_m = 0;       ///< along the optical axis
  float px_per_metre = 0;  ///< at that depth
};

/// How the world is put on a picture: optical axes (x right, y down, z ahead), in perspective or in parallel.
struct View {
  Pose view_from_world;
  bool perspective = true;
  double scale = 500;  ///< focal length in pixels, or pixels per metre
  cv::Size size{1280, 960};

  /// Nothing for points behind the camera.
  std::optional<Projected> project(Vec3 point) const;
};

/// What the pictures of maps look from.
enum class Direction { top, oblique, pose };

struct ViewOptions {
  Direction direction = Direction::oblique;
  cv::Size size{1280, 960};
  double azimuth_deg = 35;        ///< of an oblique view: from which side
  double elevation_deg = 40;      ///< of an oblique view: above the ground
  double zoom = 1;                ///< larger than 1 comes closer
  Pose world_from_camera;         ///< of a chosen pose
  double field_of_view_deg = 62;  ///< horizontal, of a chosen pose
};

/// A view that shows (nearly) all points; the few farthest ones may fall outside. `map_from_world`: z up.
View fit_view(std::span<const Vec3> points, const Pose& map_from_world, const ViewOptions& options);

/// The frame in which z is up: from `ground.json` of a grid map if `ground` names it or its folder, else from
/// the upward direction "x y z", else of a world that is a first camera's (y down). Throws
/// std::runtime_error.
Pose map_from_world(const std::string& ground, const std::string& up);

}  // namespace sediment::render
