#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "pipeline/scene/camera.hpp"

namespace sediment::synthetic {

/// A structured-light sensor (Kinect): it measures disparity d = kDisparity / z in pixels of its 640 pixel
/// wide image, with Gaussian noise, in steps of 1/8 pixel, so that the error grows with the square of the
/// depth: sigma_z = z^2 / kDisparity * sigma_d (Khoshelham and Elberink 2012).
struct DepthSensor {
  double disparity_m_px = 40.2;  ///< focal length 535.4 px x baseline 0.075 m
  double noise_px = 0.048;       ///< sigma_d before rounding
  double step_px = 0.125;        ///< of disparity
  double nearest_m = 0.4, farthest_m = 5.2;
  double fading_from_m = 4.0;  ///< from here to the farthest more and more pixels get no value
};

/// Depth as the sensor gives it (CV_16UC1, camera.depth_scale units a metre, 0 = no value) from exact depth
/// (CV_32FC1, metres). `loss` (CV_32FC1, 0 .. 1) is the share of pixels of the surface there that reflect too
/// little. No value where the projector's light is blocked, at depth edges, at grazing angles and out of
/// range.
cv::Mat measure_depth(const cv::Mat& depth_m, const cv::Mat& loss, const Camera& camera,
                      const DepthSensor& sensor, std::uint64_t seed);

/// Exact depth in the same encoding: rounded to the unit, nothing missing.
cv::Mat encode_depth(const cv::Mat& depth_m, const Camera& camera);

}  // namespace sediment::synthetic
