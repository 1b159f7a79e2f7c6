#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/scene/labelled_point.hpp"
#include "stages/project2d/plane.hpp"

namespace sediment::project2d {

/// What is known about the direction away from the centre of the Earth before the cloud is looked at.
struct UpHint {
  Vec3 up{0, -1, 0};       ///< world frame, length one
  double within_deg = 45;  ///< the ground's normal is at most this far from it
  std::string source;      ///< for ground.json: "trajectory", "given", ...
};

/// Up in the optical frame (x right, y down, z ahead) of a camera that people hold: they look ahead or down,
/// seldom up, so it is taken to be pitched down by 20 degrees.
inline constexpr Vec3 kUpwardOfCamera{0, -0.9397, -0.3420};

/// The ground of a scene and how it was found.
struct Ground {
  Plane plane;         ///< the normal points up
  std::string source;  ///< "given", "floor: ...", "largest support, ..."
  bool floor = false;  ///< nothing lies below it
  double area_m2 = 0;  ///< of the cloud on it
  double below = 0;    ///< share of the cloud's surface that lies below it
  double rms_m = 0;    ///< of the points on it
};

struct GroundParameters {
  double tolerance_m = 0.03;
  double min_area_m2 = 0.25;
  double max_below = 0.05;
  bool require_floor = false;  ///< a desk is no ground
};

/// Finds the ground in the cloud (README). Throws std::runtime_error that says the way out if there is none.
Ground find_ground(const LabelledCloud& cloud, const std::optional<UpHint>& hint,
                   const GroundParameters& parameters);

/// Reads "nx ny nz d": the plane nx x + ny y + nz z + d = 0 whose normal points up; it need not have length
/// one. Throws contract::UsageError if the text is something else.
Plane parse_plane(const std::string& text);

}  // namespace sediment::project2d
