#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "pipeline/scene/camera.hpp"

namespace sediment::synthetic {

/// A structured-light sensor (Kinect): it measures disparity d = disparity_m_px / z in pixels of its own
/// 640 pixel wide image, with Gaussian noise that neighbours share, in steps of 1/8 pixel. So the error grows
/// with the square of the depth: sigma_z = z^2 / disparity_m_px * sqrt(noise_px^2 + step_px^2 / 12), about
/// 0.0015 z^2 (Khoshelham and Elberink, Sensors 2012).
struct DepthSensor {
  double disparity_m_px = 40.2;  ///< focal length 535.4 px x baseline 0.075 m
  double noise_px = 0.048;       ///< standard deviation before rounding
  double step_px = 0.125;
  double nearest_m = 0.4, farthest_m = 5.2;
  double fading_from_m = 4.0;              ///< from here to the farthest more and more pixels get no value
  double edge_share = 0.04;                ///< a step of the depth by this share of it is an edge
  double edge_loss = 0.55;                 ///< share of the pixels at edges without value
  double slant_from = 4.5, slant_to = 11;  ///< tangent of the angle of incidence: 77 and 85 degrees
};

/// Depth as the sensor gives it (CV_16UC1, camera.depth_scale units a metre, 0 = no value) from exact depth
/// (CV_32FC1, metres, 0 = none). `loss` (CV_32FC1, 0 .. 1) is the share of pixels that reflect too little. No
/// value where something nearer blocks the projector's light, at depth edges, at grazing angles and out of
/// range. Depends on `seed` and the images alone.
cv::Mat measure_depth(const cv::Mat& depth_m, const cv::Mat& loss, const Camera& camera,
                      const DepthSensor& sensor, std::uint64_t seed);

/// Exact depth in the same encoding: rounded to the unit, nothing missing.
cv::Mat encode_depth(const cv::Mat& depth_m, const Camera& camera);

}  // namespace sediment::synthetic
