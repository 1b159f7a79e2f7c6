#pragma once

#include <filesystem>
#include <optional>

#include "pipeline/scene/camera.hpp"

namespace sediment {

/// What a sequence file says, with the defaults filled in and every path resolved.
struct SequenceFile {
  Camera camera;
  std::filesystem::path root;                    ///< folder of the lists; names in them are relative to it
  std::filesystem::path color_list, depth_list;  ///< rgb.txt and depth.txt
  std::optional<std::filesystem::path> groundtruth, accelerometer;
  double tolerance_s = 0.02;
  std::size_t start = 0;   ///< first associated frame of the window
  std::size_t count = 0;   ///< frames in the window at most, after `stride`; 0 = all
  std::size_t stride = 1;  ///< every how many-th frame
};

/// Reads a sequence file; a folder stands for its sequence.yaml. Throws std::runtime_error with file and
/// line: unknown keys, missing camera, values out of range, missing lists.
SequenceFile read_sequence_file(const std::filesystem::path& yaml);

/// Reads a camera file (configs/cameras/): width height fx fy cx cy, distortion [k1 k2 p1 p2 k3],
/// depth_scale.
Camera read_camera(const std::filesystem::path& yaml);

}  // namespace sediment
