#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/frame.hpp"
#include "pipeline/scene/labelled_point.hpp"
#include "pipeline/scene/trajectory.hpp"

namespace sediment::test {

/// What to record (tools/synthesize/README.md tells of the scenes).
struct SyntheticSettings {
  std::string scene = "walking";
  int frames = 10;
  std::uint64_t seed = 1;
  int width = 160, height = 120;
  bool noise = true;
  bool degraded = false;  ///< also make the detections of a poor network
  double rate_hz = 30;    ///< fewer frames a second show more of the action
};

/// A synthetic room in memory with exact truth. All lists are by frame.
struct SyntheticSequence {
  Camera camera;
  std::vector<Frame> frames;
  Trajectory groundtruth;               ///< world_from_camera; world: z up, floor at z = 0
  std::vector<InstanceMask> instances;  ///< an object keeps its id through the sequence
  std::vector<InstanceMask> degraded;  ///< if asked for: 30 % of the frames empty, wrong outlines and classes
  std::vector<cv::Mat> dynamic;        ///< CV_8UC1, DynamicValue; 2 only while the object is being moved
  std::vector<cv::Mat> exact_depth_m;  ///< CV_32FC1, 0 = none
  LabelledCloud static_cloud;          ///< all that never moves and that was seen, 1 cm apart
};
SyntheticSequence synthetic_sequence(const SyntheticSettings& settings);

/// Writes the sequence as `synthesize` does (sequence.yaml, rgb/, depth/, truth/) and returns the path of
/// sequence.yaml.
std::filesystem::path write_synthetic_sequence(const std::filesystem::path& folder,
                                               const SyntheticSettings& settings);

}  // namespace sediment::test
