#include "tools/synthesize/errand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/synthesize/noise_field.hpp"

namespace sediment::synthetic {
namespace {

constexpr double kStrideLength = 1.25;  // metres of a full turn of the gait: two steps
constexpr double kRamp = 0.3;           // seconds to reach the pace

struct Ease {
  double fraction, rate;
};
// Trapezoid of speed: from rest to rest, even in between.
Ease ease(double t, double duration) {
  const double ramp = std::min(kRamp, duration / 2), speed = 1 / (duration - ramp);
  if (t < ramp) return {speed * t * t / (2 * ramp), speed * t / ramp};
  if (t > duration - ramp) {
    const double left = duration - t;
    return {1 - speed * left * left / (2 * ramp), speed * left / ramp};
  }
  return {speed * (t - ramp / 2), speed};
}

double lean_of(Arms arms) {
  return arms == Arms::push ? 0.16 : arms == Arms::pick ? 0.5 : 0.04;
}

double turned(double from, double to, double fraction) {
  return from + fraction * std::remainder(to - from, 2 * std::numbers::pi);
}

}  // namespace

Errand::Errand(std::vector<Step> steps, std::uint64_t seed) : steps_(std::move(steps)), seed_(seed) {
  double walked = 0;
  walked_m_.push_back(0);
  for (std::size_t i = 1; i < steps_.size(); ++i) {
    const double dx = steps_[i].x_m - steps_[i - 1].x_m, dy = steps_[i].y_m - steps_[i - 1].y_m;
    const double ahead = std::sin(steps_[i].yaw_rad) * dx - std::cos(steps_[i].yaw_rad) * dy;
    walked += std::copysign(std::hypot(dx, dy), ahead);
    walked_m_.push_back(walked);
  }
}

Errand::Between Errand::between(double time_s) const {
  const double t = std::fmod(time_s, period_s());
  std::size_t i = 0;
  while (i + 2 < steps_.size() && t >= steps_[i + 1].time_s) ++i;
  const double duration = steps_[i + 1].time_s - steps_[i].time_s;
  const Ease e = ease(std::clamp(t - steps_[i].time_s, 0.0, duration), duration);
  const double length = walked_m_[i + 1] - walked_m_[i];
  return {&steps_[i], &steps_[i + 1], e.fraction, length * e.rate, walked_m_[i] + length * e.fraction};
}

Pose Errand::world_from_person(double time_s) const {
  const Between b = between(time_s);
  // Turns are done in the first part of the way: one looks where one goes.
  const double turn = std::min(1.0, 2.5 * b.fraction);
  return placed(
      {std::lerp(b.from->x_m, b.to->x_m, b.fraction), std::lerp(b.from->y_m, b.to->y_m, b.fraction), 0},
      turned(b.from->yaw_rad, b.to->yaw_rad, turn * turn * (3 - 2 * turn)));
}

Posture Errand::posture(double time_s) const {
  const Between b = between(time_s);
  Posture p;
  p.stride = std::clamp(std::abs(b.pace_m_s) / 0.9, 0.0, 1.0);
  p.stride_phase = 2 * std::numbers::pi * b.walked_m / kStrideLength;
  p.sitting = std::lerp(b.from->sitting, b.to->sitting, b.fraction);
  const BandLimitedNoise look(hash(seed_, 11), 0.1, 0.6), nod(hash(seed_, 12), 0.15, 0.7),
      sway(hash(seed_, 13), 0.1, 0.5);
  p.turn_rad = 0.25 * look.at(time_s);
  p.nod_rad = 0.08 + 0.07 * nod.at(time_s);
  p.lean_rad = std::lerp(lean_of(b.from->arms), lean_of(b.to->arms), b.fraction) + 0.03 * sway.at(time_s) +
               0.25 * std::sin(std::numbers::pi * p.sitting);

  const auto before = hands_of(b.from->arms, p, time_s, seed_),
             after = hands_of(b.to->arms, p, time_s, seed_);
  for (int i = 0; i < 2; ++i) p.hands[i] = before[i] + b.fraction * (after[i] - before[i]);
  return p;
}

}  // namespace sediment::synthetic
