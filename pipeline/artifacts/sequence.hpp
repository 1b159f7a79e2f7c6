#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "pipeline/scene/frame.hpp"

namespace sediment {

/// One colour image and the depth image associated with it.
struct SequenceEntry {
  std::string stamp;  ///< colour stamp as written
  double stamp_s = 0;
  double depth_stamp_s = 0;
  std::filesystem::path color, depth;
  int color_line = 0;  ///< line of rgb.txt, from 1
  int depth_line = 0;  ///< line of depth.txt, from 1
};

/// A recorded RGB-D sequence in TUM's layout, described by a YAML file (configs/sequences/): camera, lists,
/// window.
class Sequence {
 public:
  /// Reads the YAML file and the lists, associates colour and depth (TUM's rule), applies the window, and
  /// validates all that is cheap: files exist, are whole, sizes and bit depths fit the camera. Throws
  /// std::runtime_error with file and line ("rgb.txt:12: ..."); unknown YAML keys are an error.
  static Sequence open(const std::filesystem::path& yaml);

  const Camera& camera() const { return camera_; }
  std::size_t size() const { return entries_.size(); }
  const SequenceEntry& entry(std::size_t frame_idx) const { return entries_.at(frame_idx); }
  /// Colour images of the window without a depth image, and the other way round.
  std::size_t unassociated() const { return unassociated_; }

  /// Decoded images, checked against the camera's size. Safe to call from several threads. Throws
  /// std::runtime_error that names the image and its line in rgb.txt or depth.txt.
  Frame frame(std::size_t frame_idx) const;
  cv::Mat color(std::size_t frame_idx) const;
  cv::Mat depth(std::size_t frame_idx) const;

  const std::optional<std::filesystem::path>& groundtruth() const { return groundtruth_; }
  const std::optional<std::filesystem::path>& accelerometer() const { return accelerometer_; }

 private:
  Camera camera_;
  std::filesystem::path color_list_, depth_list_;
  std::vector<SequenceEntry> entries_;
  std::size_t unassociated_ = 0;
  std::optional<std::filesystem::path> groundtruth_, accelerometer_;
};

/// Indices of two ascending lists of stamps that belong together: TUM's associate.py. Of all pairs closer
/// than `tolerance_s` (strictly) the closest first, each stamp used once; sorted by the first index.
std::vector<std::pair<std::size_t, std::size_t>> associate(const std::vector<double>& first_s,
                                                           const std::vector<double>& second_s,
                                                           double tolerance_s);

}  // namespace sediment
