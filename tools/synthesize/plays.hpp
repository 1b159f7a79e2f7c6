#pragma once

#include "tools/synthesize/camera_motion.hpp"
#include "tools/synthesize/scene.hpp"
#include "tools/synthesize/workshop.hpp"

namespace sediment::synthetic {

/// What a scene is staged with.
struct Stage {
  Workshop& workshop;
  std::uint64_t motion_seed;
  double duration_s;  ///< of the sequence
};

// Each builds the room and its people and returns the camera's way.
CameraMotion play_static(Stage stage);
CameraMotion play_walking(Stage stage);
CameraMotion play_sitting(Stage stage);
CameraMotion play_carried_box(Stage stage);
CameraMotion play_rotation(Stage stage);
CameraMotion play_crowd(Stage stage);
CameraMotion play_bare(Stage stage);
CameraMotion play_loop(Stage stage);
CameraMotion play_kidnapped(Stage stage);

}  // namespace sediment::synthetic
