#include "tools/synthesize/camera_motion.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include "tools/synthesize/noise_field.hpp"
#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

/// Six independent smooth functions: three of position, three of angles.
struct Wander {
  Wander(std::uint64_t seed, double lowest_hz, double highest_hz) {
    for (int axis = 0; axis < 6; ++axis) noise.emplace_back(hash(seed, axis), lowest_hz, highest_hz);
  }
  double operator()(int axis, double time_s) const {
    return noise[static_cast<std::size_t>(axis)].at(time_s);
  }
  std::vector<BandLimitedNoise> noise;
};

struct Tremor {
  std::shared_ptr<const Wander> wander;
  explicit Tremor(std::uint64_t seed) : wander(std::make_shared<Wander>(hash(seed, 99), 1.5, 7)) {}
  Vec3 position(double t) const { return 0.0025 * Vec3{(*wander)(0, t), (*wander)(1, t), (*wander)(2, t)}; }
  double angle(int axis, double t) const { return 0.0035 * (*wander)(3 + axis, t); }
};

}  // namespace

Pose looking(Vec3 position, double yaw_rad, double pitch_rad, double roll_rad) {
  const Vec3 forward{std::sin(yaw_rad) * std::cos(pitch_rad), std::cos(yaw_rad) * std::cos(pitch_rad),
                     std::sin(pitch_rad)};
  const Vec3 level{std::cos(yaw_rad), -std::sin(yaw_rad), 0}, below = cross(forward, level);
  const Vec3 right = std::cos(roll_rad) * level + std::sin(roll_rad) * below, down = cross(forward, right);
  Pose pose;
  pose.rotation = {right.x, down.x, forward.x, right.y, down.y, forward.y, right.z, down.z, forward.z};
  pose.translation = position;
  return pose;
}

CameraMotion handheld(std::uint64_t seed, Vec3 position, double yaw_rad, double pitch_rad) {
  const auto slow = std::make_shared<Wander>(seed, 0.07, 0.45);
  const Tremor tremor(seed);
  return [=](double t) {
    const Vec3 swing{0.22 * (*slow)(0, t), 0.14 * (*slow)(1, t), 0.10 * (*slow)(2, t)};
    return looking(position + swing + tremor.position(t),
                   yaw_rad - 0.06 * (*slow)(0, t) + 0.09 * (*slow)(3, t) + tremor.angle(0, t),
                   pitch_rad + 0.05 * (*slow)(4, t) + tremor.angle(1, t),
                   0.04 * (*slow)(5, t) + tremor.angle(2, t));
  };
}

CameraMotion turning(std::uint64_t seed, Vec3 position, double yaw_rad, double pitch_rad) {
  const auto slow = std::make_shared<Wander>(seed, 0.12, 0.5);
  const Tremor tremor(seed);
  return [=](double t) {
    const Vec3 swing{0.03 * (*slow)(0, t), 0.03 * (*slow)(1, t), 0.02 * (*slow)(2, t)};
    return looking(position + swing + tremor.position(t), yaw_rad + 0.22 * (*slow)(3, t) + tremor.angle(0, t),
                   pitch_rad + 0.13 * (*slow)(4, t) + tremor.angle(1, t),
                   0.22 * (*slow)(5, t) + tremor.angle(2, t));
  };
}

Vec3 specific_force(const CameraMotion& motion, double time_s) {
  constexpr double kStep = 0.005, kGravity = 9.81;
  const Pose here = motion(time_s);
  const Vec3 acceleration =
      (motion(time_s + kStep).translation - 2 * here.translation + motion(time_s - kStep).translation) /
      (kStep * kStep);
  return here.inverse().rotate(acceleration + Vec3{0, 0, kGravity});
}

}  // namespace sediment::synthetic
