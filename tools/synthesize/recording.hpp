#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/frame.hpp"
#include "tools/synthesize/catalogue.hpp"
#include "tools/synthesize/renderer.hpp"

namespace sediment::synthetic {

/// What to record.
struct Settings {
  std::string scene = "walking";
  std::uint64_t seed = 1;
  int frames = 0;  ///< 0 = as many as the scene has by itself
  int width = 640, height = 480;
  double rate_hz = 30;
  bool noise = true;  ///< of the depth and the colour sensor
};

/// A frame and the truth about it.
struct RecordedFrame {
  Frame frame;
  Pose world_from_camera;
  InstanceMask instances;  ///< things that networks know; ids stay the same through the sequence
  cv::Mat dynamic;         ///< CV_8UC1, DynamicValue: 2 only while the object is being moved
  Moment moment;           ///< what is where
  Rendering exact;         ///< without noise
};

/// A synthetic sequence in memory: any frame can be made at any time, alone. Safe to use from several
/// threads; equal settings give equal frames.
class Recording {
 public:
  /// Throws std::invalid_argument: unknown scene (names the nearest), size or length that make no sense.
  explicit Recording(const Settings& settings);

  const Camera& camera() const { return camera_; }
  std::uint64_t seed() const { return settings_.seed; }
  const Scene& scene() const { return play_.scene; }
  const Lighting& lighting() const { return lighting_; }
  std::size_t size() const { return static_cast<std::size_t>(settings_.frames); }

  double time_s(std::size_t frame_idx) const;
  std::string stamp(std::size_t frame_idx) const;  ///< as in rgb.txt
  Pose world_from_camera(std::size_t frame_idx) const { return play_.motion(time_s(frame_idx)); }
  Pose world_from_camera_at(double time_s) const { return play_.motion(time_s); }
  Vec3 accelerometer(double time_s) const { return specific_force(play_.motion, time_s); }
  RecordedFrame frame(std::size_t frame_idx) const;

  /// Nothing reaches the sensor: black image, no depth, nothing in the masks.
  bool is_dark(std::size_t frame_idx) const;

 private:
  Settings settings_;
  Camera camera_;
  Play play_;
  Lighting lighting_;
  Renderer renderer_;
};

/// The camera of TUM's freiburg3 sequences, scaled to an image size. No lens distortion.
Camera camera_for(int width, int height);

}  // namespace sediment::synthetic
