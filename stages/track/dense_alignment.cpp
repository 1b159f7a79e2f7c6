#include "stages/track/dense_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sediment::track {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kIterations[kDenseLevels] = {5, 7, 10};
constexpr float kLeastBrightnessNoise = 3;    // grey values
constexpr double kPixelsPerObservation = 25;  // neighbours whose errors are one and the same

// Median of absolute values from a histogram over [0, 64 * unit).
class Histogram {
 public:
  explicit Histogram(float unit) : unit_(unit) {}
  void add(float absolute) {
    ++bins_[std::min(static_cast<int>(absolute * (kBins / 64.0f) / unit_), kBins - 1)];
    ++count_;
  }
  // 1.4826 times the median: the standard deviation of the good part; at least one unit.
  float robust_deviation() const {
    int below = 0, bin = 0;
    while (bin < kBins && below + bins_[bin] <= count_ / 2) below += bins_[bin++];
    return std::max(unit_, 1.4826f * unit_ * (64.0f / kBins) * (static_cast<float>(bin) + 0.5f));
  }

 private:
  static constexpr int kBins = 1024;
  float unit_;
  int count_ = 0;
  std::array<int, kBins> bins_{};
};

// Normal equations: the upper triangle row by row, then the gradient. Sums of a row of pixels are kept in
// single precision, their total in double.
struct NormalEquations {
  std::array<float, 27> row{};
  std::array<double, 27> total{};

  void add(const float* jacobian, float residual, float weight) {
    int k = 0;
    for (int a = 0; a < 6; ++a) {
      const float weighted = weight * jacobian[a];
      for (int b = a; b < 6; ++b) row[k++] += weighted * jacobian[b];
      row[21 + a] += weighted * residual;
    }
  }
  void flush() {
    for (int i = 0; i < 27; ++i) total[i] += static_cast<double>(row[i]);
    row.fill(0);
  }
  Matrix6 information() const {
    Matrix6 full;
    int k = 0;
    for (int a = 0; a < 6; ++a)
      for (int b = a; b < 6; ++b) full(a, b) = full(b, a) = total[k++] / kPixelsPerObservation;
    return full;
  }
  Vector6 gradient() const { return Eigen::Map<const Vector6>(total.data() + 21) / kPixelsPerObservation; }
};

// Sums of a Gauss-Newton step, and what the next one's robust weights need.
struct Sums {
  NormalEquations equations;
  Histogram distances{1}, differences{kLeastBrightnessNoise};  ///< of surfaces (in sigmas), of brightness
  double cross_brightness = 0, squared_brightness = 0;
  std::size_t seen = 0;
};

struct Scales {
  float distance = 3;     ///< sigmas
  float brightness = 20;  ///< grey values
  float gain = 1;         ///< brightness of the current frame over that of the reference
};

float tukey(float residual, float scale) {
  const float t = residual / (4.685f * scale);
  return std::abs(t) >= 1 ? 0 : (1 - t * t) * (1 - t * t);
}

// A camera pose and lens in single precision.
struct Projection {
  float r[9], t[3], fx, fy, cx, cy, k1, k2, p1, p2, k3;

  Projection(const DenseCamera& camera, int level, const Pose& pose) {
    for (int i = 0; i < 9; ++i) r[i] = static_cast<float>(pose.rotation[i]);
    t[0] = static_cast<float>(pose.translation.x);
    t[1] = static_cast<float>(pose.translation.y);
    t[2] = static_cast<float>(pose.translation.z);
    const Camera& full = camera.camera;
    const double block = camera.levels[level].block_px;
    fx = static_cast<float>(full.fx / block);
    fy = static_cast<float>(full.fy / block);
    cx = static_cast<float>((full.cx - 0.5 * (block - 1)) / block);
    cy = static_cast<float>((full.cy - 0.5 * (block - 1)) / block);
    float* const lens[5] = {&k1, &k2, &p1, &p2, &k3};
    for (int i = 0; i < 5; ++i) *lens[i] = static_cast<float>(full.distortion[i]);
  }
  void rotate(const float* p, float* q) const {
    for (std::ptrdiff_t i = 0; i < 3; ++i) q[i] = r[3 * i] * p[0] + r[3 * i + 1] * p[1] + r[3 * i + 2] * p[2];
  }
  void pixel(const float* p, float& u, float& v) const {
    const float x = p[0] / p[2], y = p[1] / p[2], rr = x * x + y * y;
    const float radial = 1 + rr * (k1 + rr * (k2 + rr * k3));
    u = fx * (x * radial + 2 * p1 * x * y + p2 * (rr + 2 * x * x)) + cx;
    v = fy * (y * radial + p1 * (rr + 2 * y * y) + 2 * p2 * x * y) + cy;
  }
};

void add_distance(const DensePoint& point, const float* p, const Projection& projection, const Ray& ray,
                  float depth_m, float sigma_m, const Scales& scales, Sums& sums) {
  float n[3];
  projection.rotate(&point.nx, n);
  const float distance =
      (n[0] * (p[0] - ray.x * depth_m) + n[1] * (p[1] - ray.y * depth_m) + n[2] * (p[2] - depth_m)) / sigma_m;
  sums.distances.add(std::abs(distance));
  const float weight = tukey(distance, scales.distance);
  if (weight <= 0) return;
  ++sums.seen;
  const float jacobian[6] = {(p[1] * n[2] - p[2] * n[1]) / sigma_m,
                             (p[2] * n[0] - p[0] * n[2]) / sigma_m,
                             (p[0] * n[1] - p[1] * n[0]) / sigma_m,
                             n[0] / sigma_m,
                             n[1] / sigma_m,
                             n[2] / sigma_m};
  sums.equations.add(jacobian, distance, weight / (scales.distance * scales.distance));
}

// Brightness of the current frame at a place and its derivatives by u and v (bilinear).
struct Brightness {
  float value, by_u, by_v;
};

Brightness brightness_at(const std::vector<float>& image, int width, float u, float v) {
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const float a = u - static_cast<float>(x), b = v - static_cast<float>(y);
  const float* p = image.data() + static_cast<std::ptrdiff_t>(y) * width + x;
  const float top = p[0] + a * (p[1] - p[0]), bottom = p[width] + a * (p[width + 1] - p[width]);
  // Central differences over two pixels: smoother than the derivative of the interpolation.
  const float left = p[-1] + b * (p[width - 1] - p[-1]), right = p[2] + b * (p[width + 2] - p[2]);
  const float middle_left = p[0] + b * (p[width] - p[0]), middle_right = p[1] + b * (p[width + 1] - p[1]);
  const float above = p[-width] + a * (p[1 - width] - p[-width]);
  const float* beneath = p + 2 * static_cast<std::ptrdiff_t>(width);
  const float below = beneath[0] + a * (beneath[1] - beneath[0]);
  return {top + b * (bottom - top), 0.5f * ((1 - a) * (middle_right - left) + a * (right - middle_left)),
          0.5f * ((1 - b) * (bottom - above) + b * (below - top))};
}

void add_difference(const DensePoint& point, const float* p, const Projection& projection,
                    const Brightness& seen, const Scales& scales, Sums& sums) {
  const float difference = seen.value - scales.gain * point.brightness;
  sums.differences.add(std::abs(difference));
  const float weight = tukey(difference, scales.brightness);
  if (weight <= 0) return;
  sums.cross_brightness += static_cast<double>(weight * seen.value * point.brightness);
  sums.squared_brightness += static_cast<double>(weight * point.brightness * point.brightness);
  const float gx = seen.by_u * projection.fx / p[2], gy = seen.by_v * projection.fy / p[2];
  const float gz = -(gx * p[0] + gy * p[1]) / p[2];
  const float jacobian[6] = {p[1] * gz - p[2] * gy, p[2] * gx - p[0] * gz, p[0] * gy - p[1] * gx, gx, gy, gz};
  sums.equations.add(jacobian, difference, weight / (scales.brightness * scales.brightness));
}

Sums sums_at(const DenseImage& reference, const DenseImage& current, const DenseCamera& camera, int level_idx,
             const Pose& pose, const Scales& scales, float depth_noise) {
  const auto& level = camera.levels[level_idx];
  const Projection projection(camera, level_idx, pose);
  Sums sums;
  std::size_t in_row = 0;
  for (const DensePoint& point : reference.points) {
    if (++in_row % 128 == 0) sums.equations.flush();
    float p[3], u = 0, v = 0;
    projection.rotate(&point.x, p);
    for (int i = 0; i < 3; ++i) p[i] += projection.t[i];
    if (p[2] < 0.1f) continue;
    projection.pixel(p, u, v);
    if (!(u >= 1 && v >= 1 && u < static_cast<float>(level.width - 2) &&
          v < static_cast<float>(level.height - 2)))
      continue;
    const float up_v = v + 0.5f, up_u = u + 0.5f;  // cut off, they are the nearest pixel: both are above 1
    const int nearest = static_cast<int>(up_v) * level.width + static_cast<int>(up_u);
    const float depth_m = current.depth_m[nearest];
    if (depth_m <= 0 || std::abs(depth_m - p[2]) > 0.05f + 0.1f * p[2]) continue;  // none, or another surface
    if (point.nz != 0)
      add_distance(point, p, projection, level.rays[nearest], depth_m, depth_noise * p[2] * p[2] + 0.001f,
                   scales, sums);
    add_difference(point, p, projection, brightness_at(current.brightness, level.width, u, v), scales, sums);
  }
  sums.equations.flush();
  return sums;
}

}  // namespace

DenseAlignment align(const DenseImages& reference, const DenseImages& current, const DenseCamera& camera,
                     const Pose& start, int finest_level, double depth_noise) {
  DenseAlignment result;
  result.current_from_reference = start;
  Scales scales;
  Matrix6 information = Matrix6::Zero();
  for (int level = kDenseLevels - 1; level >= finest_level; --level) {
    for (int i = 0; i < kIterations[level]; ++i) {
      const Sums sums = sums_at(reference[level], current[level], camera, level,
                                result.current_from_reference, scales, static_cast<float>(depth_noise));
      scales.distance = sums.distances.robust_deviation();
      scales.brightness = sums.differences.robust_deviation();
      if (sums.squared_brightness > 0)
        scales.gain =
            static_cast<float>(std::clamp(sums.cross_brightness / sums.squared_brightness, 0.5, 2.0));
      // Directions without information must not run away: a prior of 0.1 rad and 0.1 m about the last step.
      information = sums.equations.information();
      Matrix6 damped = information;
      damped.diagonal().array() += 100;
      const Vector6 delta = -damped.ldlt().solve(sums.equations.gradient());
      if (!delta.allFinite()) break;
      Pose& pose = result.current_from_reference;
      pose = rotation_from({delta[0], delta[1], delta[2]}) * pose;
      pose.translation = pose.translation + Vec3{delta[3], delta[4], delta[5]};
      result.overlap =
          static_cast<double>(sums.seen) / std::max<std::size_t>(1, reference[level].points.size());
      result.residual_m = scales.distance * depth_noise;
      if (delta.norm() < 1e-5) break;
    }
  }
  result.current_from_reference =
      pose_from(quaternion_of(result.current_from_reference), result.current_from_reference.translation);
  // The steps turned the translation as well: v = e + [t]x w takes the error's derivative to the step's.
  const Vec3 t = result.current_from_reference.translation;
  Matrix6 step_from_error = Matrix6::Identity();
  step_from_error.bottomLeftCorner<3, 3>() << 0, -t.z, t.y, t.z, 0, -t.x, -t.y, t.x, 0;
  const Matrix6 turned = step_from_error.transpose() * information * step_from_error;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(result.information.data()) = turned;
  return result;
}

double worst_deviation(const DenseAlignment& alignment) {
  const Matrix6 information =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(alignment.information.data());
  const double least =
      Eigen::SelfAdjointEigenSolver<Matrix6>(information, Eigen::EigenvaluesOnly).eigenvalues()[0];
  return least > 0 ? 1 / std::sqrt(least) : std::numeric_limits<double>::infinity();
}

}  // namespace sediment::track
