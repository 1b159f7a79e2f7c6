#include "stages/track/residual.hpp"

namespace sediment::track {

Measurement measurement_of(const Feature& feature, const Pinhole& pinhole, double noise_scale) {
  Measurement measurement;
  measurement.u_px = feature.u_px;
  measurement.v_px = feature.v_px;
  measurement.inverse_depth = feature.inverse_depth;
  measurement.pixel_weight = 1 / (noise_scale * pinhole.pixel_sigma_px * kLevelScale[feature.octave]);
  measurement.depth_weight = 1 / (noise_scale * pinhole.depth_sigma);
  measurement.u_rate = feature.u_rate;
  measurement.v_rate = feature.v_rate;
  measurement.depth_rate = feature.depth_rate;
  return measurement;
}

std::array<double, 3> residual_of(const Measurement& measurement, const Pinhole& pinhole, Vec3 point) {
  const double inverse_z = 1.0 / point.z;
  return {measurement.pixel_weight * (pinhole.fx * point.x * inverse_z + pinhole.cx - measurement.u_px),
          measurement.pixel_weight * (pinhole.fy * point.y * inverse_z + pinhole.cy - measurement.v_px),
          measurement.inverse_depth > 0 ? measurement.depth_weight * (inverse_z - measurement.inverse_depth)
                                        : 0.0};
}

std::array<double, 9> residual_by_point(const Measurement& measurement, const Pinhole& pinhole, Vec3 point) {
  const double inverse_z = 1.0 / point.z;
  const double by_x = measurement.pixel_weight * pinhole.fx * inverse_z;
  const double by_y = measurement.pixel_weight * pinhole.fy * inverse_z;
  const double by_depth =
      measurement.inverse_depth > 0 ? -measurement.depth_weight * inverse_z * inverse_z : 0.0;
  return {by_x, 0, -by_x * point.x * inverse_z, 0, by_y, -by_y * point.y * inverse_z, 0, 0, by_depth};
}

}  // namespace sediment::track
