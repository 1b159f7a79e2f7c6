#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/scene/camera.hpp"
#include "stages/track/parameters.hpp"
#include "stages/track/sensor_timing.hpp"

namespace sediment::track {

inline constexpr int kPyramidLevels = 8;
inline constexpr float kPyramidScale = 1.2f;
/// Size of a pixel of a pyramid level in pixels of level 0.
extern const std::array<float, kPyramidLevels> kLevelScale;

/// 256 bits of an ORB descriptor.
using Descriptor = std::array<std::uint64_t, 4>;

inline int hamming_distance(const Descriptor& a, const Descriptor& b) {
  return __builtin_popcountll(a[0] ^ b[0]) + __builtin_popcountll(a[1] ^ b[1]) +
         __builtin_popcountll(a[2] ^ b[2]) + __builtin_popcountll(a[3] ^ b[3]);
}

/// One ORB feature of a frame. Positions are in the ideal pinhole image, the lens undone.
struct Feature {
  float u_px = 0, v_px = 0;  ///< where it would be, had all rows been read at the frame's stamp
  float inverse_depth = 0;   ///< 1/m at the frame's stamp, 0 = no reliable depth
  float u_rate = 0, v_rate = 0,
        depth_rate = 0;                ///< change of the above per second of readout and of depth lag
  float angle_deg = 0;                 ///< orientation of the patch
  int octave = 0;                      ///< pyramid level
  float seen_u_px = 0, seen_v_px = 0;  ///< where it was found
  float row = 0;                       ///< of the raw image, -0.5 (first) .. 0.5 (last)
};

/// The features of one frame, with a grid over the image for searches by place.
class FrameFeatures {
 public:
  FrameFeatures() = default;
  FrameFeatures(std::vector<Feature> features, std::shared_ptr<const std::vector<Descriptor>> descriptors,
                int width, int height);

  std::size_t size() const { return features_.size(); }
  const Feature& feature(std::size_t feature_idx) const { return features_[feature_idx]; }
  const Descriptor& descriptor(std::size_t feature_idx) const { return (*descriptors_)[feature_idx]; }
  const std::vector<Feature>& features() const { return features_; }
  const std::shared_ptr<const std::vector<Descriptor>>& descriptors() const { return descriptors_; }

  /// These features and behind them `more` of the same image.
  FrameFeatures joined(const FrameFeatures& more) const;

  /// Appends the indices of the features within `radius_px` (square) of a place and with an octave in
  /// [min_octave, max_octave] to `found`, after clearing it. Fixed order.
  void find_near(float u_px, float v_px, float radius_px, int min_octave, int max_octave,
                 std::vector<int>& found) const;

 private:
  int cell_of(float position_px, int cells) const;
  void fill_grid();

  std::vector<Feature> features_;
  std::shared_ptr<const std::vector<Descriptor>> descriptors_;
  int columns_ = 0, rows_ = 0;
  std::vector<int> cell_start_;  ///< columns * rows + 1 offsets into cell_features_
  std::vector<int> cell_features_;
};

/// About `wanted` ORB features of a frame (Rublee et al., ICCV 2011): FAST corners over a pyramid, spread
/// evenly over the image, none where `allowed` (CV_8UC1, may be empty) is 0. `gray` is CV_8UC1 and raw.
/// Without depth yet: measured_features adds it.
FrameFeatures find_features(const cv::Mat& gray, const cv::Mat& allowed, const Camera& camera, int wanted);

/// 255 where features may be, 0 on the dynamic pixels of a mask (any value but 0) and within their halo;
/// empty if the mask is.
cv::Mat allowed_pixels(const cv::Mat& dynamic_mask, int halo_px);

/// What is known of the camera while it took a frame.
struct Exposure {
  Motion motion;
  SensorTiming timing;
  double depth_delay_s = 0;  ///< stamp of the depth image - stamp of the colour image
};

/// The same features with depth from the raw depth image (CV_16UC1), places and depths moved to the time of
/// the frame's stamp: rows of a rolling shutter are taken at different times, and so is the depth image.
FrameFeatures measured_features(const FrameFeatures& found, const cv::Mat& depth, const Camera& camera,
                                const Exposure& exposure, const Parameters& parameters);

/// Measured features after a small change of the sensor's timing, to first order: no image is read again.
FrameFeatures retimed_features(const FrameFeatures& measured, const SensorTiming& change, int width,
                               int height);

}  // namespace sediment::track
