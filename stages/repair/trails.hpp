#pragma once

#include <functional>

#include "pipeline/motion/pixel_trails.hpp"
#include "stages/repair/clip.hpp"

namespace sediment::repair {

constexpr int kStep_px = 2;  ///< of the grid of pixels that are followed through the clip

enum class Direction { backward = -1, forward = 1 };

/// Follows the pixels of frame `from_idx` (a grid of `step_px`) through the frames before or after it, up to
/// `reach` frames or to the end of what is in memory. `visit(frame, trails)` is called for each frame
/// reached; it returns false to stop.
void walk(const Clip& clip, std::size_t from_idx, Direction direction, int reach, int step_px,
          double depth_scale, const std::function<bool(const ClipFrame&, const PixelTrails&)>& visit);

}  // namespace sediment::repair
