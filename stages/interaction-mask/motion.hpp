#pragma once

#include <optional>
#include <set>
#include <vector>

namespace sediment::interaction_mask {

struct MotionParameters {
  double start_m_s = 0.1;  ///< an object moves for certain above this speed
  double stop_m_s = 0.04;  ///< and rests below this
  int min_frames = 3;      ///< that a motion has above start_m_s
  int memory = 15;         ///< frames between a touch and the motion it causes, or the other way round
  int margin = 3;          ///< frames more on either side of a motion: a ghost costs more than they do
};

/// What is known of one prior static object in one frame.
struct ObjectState {
  int id = 0;                       ///< the same in all frames
  std::optional<double> speed_m_s;  ///< none: not known
  bool touched = false;             ///< the paper's test: interacting with what moves by itself
};

/// Which objects are non-prior dynamic in each frame: those that are in motion and are touched at some time
/// of the motion, or up to `memory` frames before or after it. A motion reaches, forward and backward, from
/// where it is certain to where the object rests, and `margin` frames beyond: so it begins with the first
/// movement, and its rest before and after is static. Where the speed of a touched object is not known, the
/// touch decides, as in the paper.
std::vector<std::set<int>> moved_objects(const std::vector<std::vector<ObjectState>>& frames,
                                         const MotionParameters& parameters);

}  // namespace sediment::interaction_mask
