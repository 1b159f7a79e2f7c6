#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/frame.hpp"
#include "pipeline/scene/trajectory.hpp"

namespace sediment::test {

/// A small RGB-D sequence in memory, to be changed as a test wants it and then written.
struct TinySequence {
  Camera camera;
  std::vector<Frame> frames;  ///< stamps 100.000000, 100.040000, ...
  Trajectory groundtruth;     ///< world_from_camera of every frame
};

/// A textured wall exactly 2 m in front of a camera (64 x 48 pixels, no distortion) that moves 1 cm to the
/// right from frame to frame. The top row of the depth images has no depth.
TinySequence tiny_sequence(int frame_count = 3);

/// Writes it in TUM's layout: rgb/, depth/, rgb.txt, depth.txt (depth stamps are 4 ms later), groundtruth.txt
/// and sequence.yaml, whose path is returned.
std::filesystem::path write_sequence(const std::filesystem::path& folder, const TinySequence& sequence);

}  // namespace sediment::test
