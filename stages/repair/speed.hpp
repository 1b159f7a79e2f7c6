#pragma once

#include <map>
#include <optional>
#include <vector>

#include "pipeline/motion/camera_motion.hpp"
#include "stages/repair/clip.hpp"

namespace sediment::repair {

/// How far an object moved to the next frame, against what stands still: across the view, in metres.
struct Displacement {
  double x_m = 0, y_m = 0;
  double seconds = 0;
  double error_m = 0;  ///< how far the things that stand still seem to move, at the object's depth
};

/// Displacements of the instances of a frame by id, from the optical flow to the next one, where it holds in
/// both directions: what the motion of the camera leaves unexplained, the median over the instance's pixels.
/// The camera's motion is fitted to the pixels that are not in `movers` (ids of instances that may move by
/// themselves). Empty if there is no next frame or no camera motion fits; an instance with few pixels with
/// depth is left out. `rays` are those of the camera.
std::map<int, Displacement> displacements(const ClipFrame& frame, const ClipFrame& next,
                                          const InstanceMask& mask, const std::vector<int>& movers,
                                          const Camera& camera, const std::vector<Ray>& rays);

/// Speed at each frame of one object: the length of the sum of the displacements up to two frames before and
/// after it, less the sum of their errors, over their time. Summing vectors first lets the noise cancel; what
/// blur and rolling shutters do to a whole region does not, and is what the error takes off. Keys are frame
/// indices.
std::map<std::size_t, double> speeds(const std::map<std::size_t, Displacement>& displacements);

}  // namespace sediment::repair
