#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/frame.hpp"
#include "pipeline/scene/trajectory.hpp"
#include "stages/track/parameters.hpp"
#include "stages/track/sensor_timing.hpp"

namespace sediment::track {

/// A recording, frame by frame. Both functions are called from several threads.
struct Recording {
  Camera camera;
  std::vector<std::string> stamps;
  std::vector<double> stamps_s;
  std::vector<double> depth_stamps_s;  ///< empty: those of colour
  std::function<Frame(std::size_t frame_idx)> frame;
  std::function<cv::Mat(std::size_t frame_idx)> depth;         ///< unset: frame(i).depth
  std::function<cv::Mat(std::size_t frame_idx)> dynamic_mask;  ///< DynamicValue; may be unset
};

/// A feature of a keyframe where it was found in the raw image.
struct ShownFeature {
  float u_px = 0, v_px = 0;
  bool held = false;  ///< by a landmark that other keyframes see too
};

struct KeyframeFeatures {
  std::size_t frame_idx = 0;
  std::vector<ShownFeature> features;
};

/// How landmarks fit the keyframes that see them.
struct Diagnosis {
  std::vector<KeyframeFeatures> keyframes;
  std::vector<float> error_px;     ///< reprojection errors
  std::vector<float> depth_error;  ///< of inverse depth, in standard deviations
};

/// What came out of tracking.
struct Tracked {
  Trajectory poses;                   ///< of the frames that have one; the first one's camera is the world
  std::vector<Trajectory> apart;      ///< parts that could not be joined to `poses`, each in its own world
  std::vector<FrameTracking> frames;  ///< one a frame of the recording
  std::size_t landmarks = 0;
  int segments = 0;  ///< parts of the recording that could not be joined; poses are those of the largest
  int loops = 0;     ///< pairs of keyframes found to show one place
  int still_landmarks = 0;  ///< on dynamic pixels, used because they hold still
  Diagnosis diagnosis;
  SensorTiming timing;  ///< as found from the recording
};

/// Camera poses of a recording from its ORB features: front end, map, and, after the last frame, closing of
/// loops, an adjustment of everything and a pose for every frame from the final map. Mode::causal: the poses
/// that the front end had at each frame. The same for any number of
/// threads. Throws std::runtime_error where time does not go forward.
Tracked track(const Recording& recording, const Parameters& parameters, const std::function<void()>& advance);

/// Tracked frames / frames; 0 without frames.
double coverage(const std::vector<FrameTracking>& frames);

/// Throws std::runtime_error if less than `min_coverage` of the frames have a pose.
void require_coverage(const std::vector<FrameTracking>& frames, double min_coverage);

}  // namespace sediment::track
