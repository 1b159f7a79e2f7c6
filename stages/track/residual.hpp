#pragma once

#include <array>

#include "stages/track/pinhole.hpp"

namespace sediment::track {

/// What a frame measured of a landmark.
struct Measurement {
  double u_px = 0, v_px = 0;
  double inverse_depth = 0;                       ///< 0 = none: its row of the residual is 0
  double pixel_weight = 1;                        ///< 1 / standard deviation, 1/px
  double depth_weight = 1;                        ///< 1 / standard deviation, m
  double u_rate = 0, v_rate = 0, depth_rate = 0;  ///< change per second of readout (u, v) and of depth lag
};

/// `noise_scale`: how much noisier the frame is than most.
Measurement measurement_of(const Feature& feature, const Pinhole& pinhole, double noise_scale = 1);

/// Residual of a landmark in units of standard deviations: u, v and inverse depth. The depth of a Kinect
/// comes from a disparity, whose error does not depend on the distance; so the inverse depth is what has a
/// constant variance (Khoshelham and Elberink, Sensors 2012), as in ORB-SLAM2's virtual right image
/// coordinate.
std::array<double, 3> residual_of(const Measurement& measurement, const Pinhole& pinhole,
                                  Vec3 point_in_camera);

/// Derivative of residual_of by the point in the camera frame, row-major 3 x 3.
std::array<double, 9> residual_by_point(const Measurement& measurement, const Pinhole& pinhole,
                                        Vec3 point_in_camera);

inline constexpr double kProjectable_m = 0.05;  ///< a point nearer or behind cannot be projected

inline double squared(const std::array<double, 3>& r) {
  return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
}

/// Squared bounds at 95 % of a chi-square distribution: 2 (no depth) and 3 degrees of freedom.
inline constexpr double kChiSquare2 = 5.991, kChiSquare3 = 7.815;

inline double chi_square_bound(const Measurement& measurement) {
  return measurement.inverse_depth > 0 ? kChiSquare3 : kChiSquare2;
}

}  // namespace sediment::track
