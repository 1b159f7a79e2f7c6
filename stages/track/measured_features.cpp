#include <algorithm>
#include <cmath>

#include "stages/track/features.hpp"
#include "stages/track/reliable_depth.hpp"

namespace sediment::track {
namespace {

constexpr double kDifference_s = 0.02;  // of depth lag, for the rate of depth

// Inverse depth at the stamp of the point that the camera sees along `ray` at that time; 0 if there is none.
// The depth image was taken `delay_s` later, when the point was at another of its pixels.
double inverse_depth_at(const Vec3& ray, const cv::Mat& depth, const Camera& camera, const Exposure& exposure,
                        double delay_s, const Parameters& parameters) {
  const Pose stamp_from_depth = moved(exposure.motion, delay_s);
  const Vec3 then = stamp_from_depth.inverse().rotate(ray);
  if (then.z < 0.1) return 0;
  const Pixel pixel = camera.project(then);
  const double depth_m =
      reliable_depth_m(depth, static_cast<int>(std::lround(pixel.u)), static_cast<int>(std::lround(pixel.v)),
                       camera.depth_scale, parameters.depth_noise);
  if (depth_m <= 0 || depth_m > parameters.depth_max_m) return 0;
  const double now_m = (stamp_from_depth * (depth_m / then.z * then)).z;
  return now_m > 0.05 ? 1 / now_m : 0;
}

Feature measured(Feature feature, const cv::Mat& depth, const Camera& camera, const Exposure& exposure,
                 const Parameters& parameters) {
  const auto ray_at_stamp = [&](double readout_s, double inverse_depth) {
    const Vec3 seen{(feature.seen_u_px - camera.cx) / camera.fx, (feature.seen_v_px - camera.cy) / camera.fy,
                    1};
    const Pose motion = moved(exposure.motion, feature.row * readout_s);
    const Vec3 ray = motion.rotate(seen) + inverse_depth * motion.translation;
    return ray / ray.z;
  };
  const double readout_s = exposure.timing.readout_s;
  // Both images are taken as read out alike: the depth of a row is as late as its colour.
  const double delay_s = exposure.depth_delay_s + exposure.timing.depth_lag_s + feature.row * readout_s;
  const Vec3 turned = ray_at_stamp(readout_s, 0);
  const auto inverse_depth = [&](double lag_s) {
    return inverse_depth_at(turned, depth, camera, exposure, delay_s + lag_s, parameters);
  };
  const double q = inverse_depth(0);
  const Vec3 ray = ray_at_stamp(readout_s, q);
  feature.u_px = static_cast<float>(camera.fx * ray.x + camera.cx);
  feature.v_px = static_cast<float>(camera.fy * ray.y + camera.cy);
  feature.inverse_depth = static_cast<float>(q);
  const double difference_s = 1e-3;
  const Vec3 faster = ray_at_stamp(readout_s - difference_s, q),
             slower = ray_at_stamp(readout_s + difference_s, q);
  feature.u_rate = static_cast<float>(camera.fx * (slower.x - faster.x) / (2 * difference_s));
  feature.v_rate = static_cast<float>(camera.fy * (slower.y - faster.y) / (2 * difference_s));
  feature.depth_rate = 0;
  if (q > 0) {
    const double earlier = inverse_depth(-kDifference_s), later = inverse_depth(kDifference_s);
    const bool even = std::abs(earlier + later - 2 * q) < 3 * parameters.depth_noise;
    if (earlier > 0 && later > 0 && even)
      feature.depth_rate = static_cast<float>((later - earlier) / (2 * kDifference_s));
  }
  return feature;
}

}  // namespace

FrameFeatures measured_features(const FrameFeatures& found, const cv::Mat& depth, const Camera& camera,
                                const Exposure& exposure, const Parameters& parameters) {
  std::vector<Feature> features;
  features.reserve(found.size());
  for (const Feature& feature : found.features())
    features.push_back(measured(feature, depth, camera, exposure, parameters));
  return FrameFeatures(std::move(features), found.descriptors(), camera.width, camera.height);
}

FrameFeatures retimed_features(const FrameFeatures& measured, const SensorTiming& change, int width,
                               int height) {
  std::vector<Feature> features = measured.features();
  for (Feature& feature : features) {
    feature.u_px += static_cast<float>(change.readout_s) * feature.u_rate;
    feature.v_px += static_cast<float>(change.readout_s) * feature.v_rate;
    if (feature.inverse_depth > 0)
      feature.inverse_depth = std::max(
          1e-3f, feature.inverse_depth + static_cast<float>(change.depth_lag_s) * feature.depth_rate);
  }
  return FrameFeatures(std::move(features), measured.descriptors(), width, height);
}

}  // namespace sediment::track
