#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "pipeline/scene/camera.hpp"

namespace sediment::track {

inline constexpr int kDenseLevels = 3;

/// Geometry of the small images that are aligned as a whole: level 0 is about 160 pixels wide, each further
/// level half of it. They are raw: the lens is undone by the ray of every pixel.
struct DenseCamera {
  struct Level {
    int width = 0, height = 0;
    int block_px = 0;       ///< side of the block of full-size pixels that makes one
    std::vector<Ray> rays;  ///< per pixel
  };
  Camera camera;
  std::array<Level, kDenseLevels> levels;

  explicit DenseCamera(const Camera& camera);
  /// Position in a level's image of a point of the camera frame with z > 0.
  Pixel project(Vec3 point, int level) const;
};

/// Brightness and depth of a frame at level 0. Small enough (58 KB) to be kept for every frame.
struct DenseFrame {
  cv::Mat brightness;  ///< CV_8UC1
  cv::Mat depth;       ///< CV_16UC1, camera units, 0 = none, an edge, or a dynamic pixel
};

/// Means over blocks; depth only where a block has enough of it and no edge goes through. `allowed` (CV_8UC1,
/// may be empty) is 0 at pixels that may move: those have no depth, and so no part in any alignment.
DenseFrame dense_frame(const cv::Mat& gray, const cv::Mat& depth, const cv::Mat& allowed,
                       const DenseCamera& camera, double depth_noise);

/// A pixel that takes part in alignments.
struct DensePoint {
  float x = 0, y = 0, z = 0;     ///< metres, camera frame
  float nx = 0, ny = 0, nz = 0;  ///< normal, 0 if there is none
  float brightness = 0;
};

/// One level of a frame, ready for alignment.
struct DenseImage {
  std::vector<float> brightness;
  std::vector<float> depth_m;      ///< 0 = none
  std::vector<DensePoint> points;  ///< of the pixels with depth, row by row
};

/// All levels of a frame.
std::array<DenseImage, kDenseLevels> dense_images(const DenseFrame& frame, const DenseCamera& camera,
                                                  double depth_noise);

}  // namespace sediment::track
