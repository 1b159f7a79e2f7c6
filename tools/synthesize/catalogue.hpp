#pragma once

#include <string>
#include <vector>

#include "tools/synthesize/camera_motion.hpp"
#include "tools/synthesize/scene.hpp"

namespace sediment::synthetic {

/// A scene by name, with the camera's way through it.
struct Play {
  Scene scene;
  CameraMotion motion;
  double blackout_from = 1, blackout_to = 1;  ///< share of the sequence without light on the sensor
};

/// What there is to choose from.
struct Title {
  std::string name, summary;
  int default_frames;
};
const std::vector<Title>& titles();

/// Stages a scene. `duration_s` is the length of the sequence, `texel_m` as for Workshop. Throws
/// std::invalid_argument that names the nearest scene if there is none of this name.
Play stage_play(const std::string& name, std::uint64_t seed, double duration_s, double texel_m);

}  // namespace sediment::synthetic
