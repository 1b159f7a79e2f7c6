#include "stages/track/smoothing.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sediment::track {
namespace {

constexpr std::size_t kFewest = 10;
constexpr double kAxes = 3;
constexpr double kMostScale = 3;  // what is more than the measured poses' deviations by this is motion

using Axes = Eigen::Matrix<double, 2, 3>;  // value and rate of three axes that share their variances
using Covariance = Eigen::Matrix2d;

/// Three axes of a signal, sampled.
struct Samples {
  std::vector<double> times_s;
  std::vector<Eigen::RowVector3d> values;
  std::vector<double> variances;
};

struct Filtered {
  std::vector<Axes> predicted, updated;
  std::vector<Covariance> predicted_covariance, updated_covariance;
  double score = 0;  ///< minus twice the logarithm of the likelihood, less a constant
};

Covariance transition(double dt) {
  return (Covariance() << 1, dt, 0, 1).finished();
}

/// Kalman filter with accelerations of spectral density `drift`. The scale of all variances is free within
/// limits: the score is that of the likeliest one.
Filtered filter(const Samples& samples, double drift) {
  const std::size_t n = samples.times_s.size();
  constexpr std::size_t kUnknown = 2;  // value and rate at the start: the first samples tell these only
  const double span_s = samples.times_s.back() - samples.times_s.front();
  const double wide = 1e6 * *std::max_element(samples.variances.begin(), samples.variances.end());
  Filtered result;
  Axes state = Axes::Zero();
  state.row(0) = samples.values.front();
  Covariance covariance = Covariance::Zero();
  covariance.diagonal() << wide, wide * static_cast<double>(n * n) / (span_s * span_s);
  double log_variances = 0, squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      const double dt = samples.times_s[i] - samples.times_s[i - 1];
      const Covariance f = transition(dt);
      Covariance noise;
      noise << dt * dt * dt / 3, dt * dt / 2, dt * dt / 2, dt;
      state = f * state;
      covariance = f * covariance * f.transpose() + drift * noise;
    }
    result.predicted.push_back(state);
    result.predicted_covariance.push_back(covariance);
    const Eigen::RowVector3d surprise = samples.values[i] - state.row(0);
    const double variance = covariance(0, 0) + samples.variances[i];
    if (i >= kUnknown) {
      log_variances += std::log(variance);
      squares += surprise.squaredNorm() / variance;
    }
    const Eigen::Vector2d gain = covariance.col(0) / variance;
    state += gain * surprise;
    covariance -= gain * covariance.row(0).eval();
    covariance = 0.5 * (covariance + covariance.transpose()).eval();
    result.updated.push_back(state);
    result.updated_covariance.push_back(covariance);
  }
  const auto counted = static_cast<double>(n - kUnknown);
  const double scale = std::min(squares / (kAxes * counted), kMostScale * kMostScale);
  result.score = log_variances + counted * std::log(scale) + squares / (kAxes * scale);
  return result;
}

std::vector<Eigen::RowVector3d> smoothed_backwards(const Samples& samples, const Filtered& filtered) {
  const std::size_t n = samples.times_s.size();
  std::vector<Eigen::RowVector3d> values(n);
  Axes state = filtered.updated.back();
  values.back() = state.row(0);
  for (std::size_t i = n - 1; i-- > 0;) {
    const Covariance gain = filtered.updated_covariance[i] *
                            transition(samples.times_s[i + 1] - samples.times_s[i]).transpose() *
                            filtered.predicted_covariance[i + 1].inverse();
    state = filtered.updated[i] + gain * (state - filtered.predicted[i + 1]);
    values[i] = state.row(0);
  }
  return values;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<Eigen::RowVector3d> smoothed(const Samples& samples) {
  constexpr int kSmoothest = -30, kRoughest = 14;  // powers of two
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < samples.times_s.size(); ++i)
    steps_s.push_back(samples.times_s[i] - samples.times_s[i - 1]);
  const double unit = median(samples.variances) / std::pow(median(steps_s), 3);
  double best = std::numeric_limits<double>::infinity(), drift = 0;
  for (int power = kRoughest; power >= kSmoothest; --power) {
    const double tried = unit * std::exp2(power), score = filter(samples, tried).score;
    if (score < best) {
      best = score;
      drift = tried;
    }
  }
  return drift > 0 ? smoothed_backwards(samples, filter(samples, drift)) : samples.values;
}

Eigen::RowVector3d row(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

std::vector<Pose> smoothed(const std::vector<MeasuredPose>& poses) {
  std::vector<Pose> result;
  for (const MeasuredPose& pose : poses) result.push_back(pose.world_from_camera);
  if (poses.size() < kFewest) return result;
  // Turns from frame to frame, added up: what is smooth in them is smooth in the rotation.
  Samples turned, centre;
  Eigen::RowVector3d angle = Eigen::RowVector3d::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const MeasuredPose& pose = poses[i];
    if (i > 0) angle += row(rotation_vector(result[i - 1].inverse() * result[i]));
    turned.times_s.push_back(pose.stamp_s);
    turned.values.push_back(angle);
    turned.variances.push_back(pose.deviation_rad * pose.deviation_rad);
    centre.values.push_back(row(pose.world_from_camera.translation));
    centre.variances.push_back(pose.deviation_m * pose.deviation_m);
  }
  centre.times_s = turned.times_s;
  const auto angles = smoothed(turned), centres = smoothed(centre);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::RowVector3d change = angles[i] - turned.values[i];
    Pose pose = result[i];
    pose.translation = {};
    pose = pose * rotation_from({change[0], change[1], change[2]});
    pose.translation = {centres[i][0], centres[i][1], centres[i][2]};
    result[i] = pose_from(quaternion_of(pose), pose.translation);
  }
  return result;
}

}  // namespace sediment::track
