#pragma once

#include <functional>
#include <vector>

#include "stages/track/track.hpp"

namespace sediment::track::test {

/// What the camera of a box room can be made to suffer from.
struct Trouble {
  std::function<bool(std::size_t frame_idx)> black, no_depth,
      masked;              ///< frames without light, depth, or all masked
  double depth_noise = 0;  ///< standard deviation of the inverse depth, 1/m
};

/// A recording of the inside of a room of 5 x 3 x 6 m, its walls covered with patches of random grey values
/// of three sizes, rendered exactly from the poses given (world: the middle of the room, x right, y down, z
/// ahead).
Recording record_box_room(const std::vector<Pose>& world_from_camera, const Camera& camera,
                          const Trouble& trouble = {}, double frame_period_s = 1.0 / 30);

/// The pinhole camera of TUM's freiburg3 at half its size, to be quick.
Camera small_camera();

/// A hand-held camera that sways and turns: `frames` poses, smooth.
std::vector<Pose> swaying_poses(std::size_t frames, double metres, double radians);

/// Root mean square distance of the positions from the truth after the best rigid alignment (ATE).
double position_error_m(const Tracked& tracked, const std::vector<Pose>& truth);

}  // namespace sediment::track::test
