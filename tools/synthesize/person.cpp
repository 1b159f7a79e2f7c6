#include "tools/synthesize/person.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synthesize/noise_field.hpp"
#include "tools/synthesize/patterns.hpp"

namespace sediment::synthetic {
namespace {

// An adult of about 1.75 m.
constexpr double kThigh = 0.43, kShin = 0.42, kSole = 0.075, kTrunk = 0.50, kUpperArm = 0.29, kForearm = 0.27;
constexpr double kHipWidth = 0.09, kShoulderWidth = 0.185, kSeatedHip = 0.60;

/// Direction reached from straight down by turning `angle` to the front.
Vec3 down_and_forward(double angle_rad) {
  return {0, -std::sin(angle_rad), -std::cos(angle_rad)};
}

struct Leg {
  double hip_rad, knee_rad;
  Vec3 knee, ankle;
};

// Gait: hip swings as a sine, the knee bends while the leg swings forward (Perry's curves, roughly).
Leg leg_of(const Posture& p, int side) {
  const double phase = p.stride_phase + (side > 0 ? 0 : 3.14159265358979);
  const double walk_hip = 0.06 + 0.42 * std::sin(phase),
               walk_knee = 0.10 + 0.85 * std::pow(std::max(0.0, std::cos(phase + 0.35)), 2);
  Leg leg{};
  leg.hip_rad = std::lerp(p.stride * walk_hip, 1.45, p.sitting);
  leg.knee_rad = std::lerp(p.stride * walk_knee, 1.45, p.sitting);
  leg.knee = Vec3{side * (kHipWidth + 0.05 * p.sitting), 0, 0} + kThigh * down_and_forward(leg.hip_rad);
  leg.ankle = leg.knee + kShin * down_and_forward(leg.hip_rad - leg.knee_rad);
  return leg;
}

/// Elbow of an arm from shoulder to hand, bent down and outward; the hand is drawn in if it is out of reach.
Vec3 elbow_of(Vec3 shoulder, Vec3& hand, int side) {
  const Vec3 reach = hand - shoulder;
  const double length = std::clamp(norm(reach), 0.12, 0.995 * (kUpperArm + kForearm));
  const Vec3 direction = norm(reach) > 1e-6 ? normalized(reach) : Vec3{0, 0, -1};
  hand = shoulder + length * direction;
  const double along = (kUpperArm * kUpperArm - kForearm * kForearm + length * length) / (2 * length);
  const double off = std::sqrt(std::max(0.0, kUpperArm * kUpperArm - along * along));
  const Vec3 hint{0.3 * side, 0.45, -0.8};
  return shoulder + along * direction + off * normalized(hint - dot(hint, direction) * direction);
}

void add_legs(std::vector<Solid>& body, const Posture& p, const Outfit& outfit, Vec3 pelvis) {
  for (const int side : {1, -1}) {  // left is +x for one whose front is -y
    const Leg leg = leg_of(p, side);
    const Vec3 hip = pelvis + Vec3{side * kHipWidth, 0, 0}, knee = pelvis + leg.knee,
               ankle = pelvis + leg.ankle;
    const double pitch = std::lerp(0.5 * (leg.hip_rad - leg.knee_rad) * p.stride, 0.0, p.sitting);
    const Vec3 toe = ankle + Vec3{0, -0.19 * std::cos(pitch), 0.19 * std::sin(pitch) - 0.02};
    body.push_back(limb(hip, knee, 0.085, 0.058, outfit.trousers));
    body.push_back(limb(knee, ankle, 0.060, 0.045, outfit.trousers));
    body.push_back(limb(ankle + Vec3{0, 0.03, -0.025}, toe + Vec3{0, 0, -0.01}, 0.048, 0.036, outfit.shoes));
  }
}

void add_head(std::vector<Solid>& body, const Posture& p, const Outfit& outfit, Vec3 neck) {
  Pose head = rotation_from({0, 0, p.turn_rad}) * rotation_from({p.nod_rad, 0, 0});
  head.translation = neck + Vec3{0, -0.015, 0.12};
  const auto at = [&](double x, double y, double z) { return head * Vec3{x, y, z}; };
  const Vec3 side = head.rotate({1, 0, 0});
  const auto ball = [&](Vec3 centre, double radius, int material) {
    body.push_back(limb(centre, centre, radius, radius, material));
  };
  body.push_back(limb(neck + Vec3{0, 0.01, -0.03}, at(0, 0.01, 0), 0.055, 0.055, outfit.skin));
  body.push_back(limb(at(0, -0.025, -0.045), at(0, -0.005, 0.06), 0.062, 0.090, outfit.skin, 1.1,
                      side));  // chin to forehead
  body.push_back(limb(at(0, 0.045, 0.005), at(0, 0.018, 0.078), 0.078, 0.092, outfit.hair, 1.08, side));
  body.push_back(limb(at(0, -0.03, 0.125), at(0, 0.02, 0.12), 0.055, 0.07, outfit.hair));    // forelock
  body.push_back(limb(at(0, -0.103, 0.0), at(0, -0.093, 0.035), 0.016, 0.01, outfit.skin));  // nose
  body.push_back(limb(at(-0.017, -0.083, -0.043), at(0.017, -0.083, -0.043), 0.009, 0.009, outfit.lips));
  for (const double x : {-0.034, 0.034}) {
    ball(at(x, -0.079, 0.042), 0.017, outfit.eyes);
    ball(at(x, -0.0905, 0.042), 0.0085, outfit.shoes);  // dark pupils
    body.push_back(
        limb(at(x - 0.016, -0.086, 0.066), at(x + 0.016, -0.086, 0.066), 0.006, 0.006, outfit.hair));
    body.push_back(limb(at(2.7 * x, 0.0, 0.0), at(2.75 * x, 0.004, 0.035), 0.013, 0.017, outfit.skin));
  }
}

}  // namespace

Outfit dress(Workshop& w) {
  constexpr Rgb kShirts[] = {
      {.66f, .20f, .18f}, {.22f, .38f, .64f}, {.80f, .76f, .66f}, {.24f, .48f, .32f}, {.80f, .58f, .22f}};
  constexpr Rgb kSkins[] = {{.88f, .68f, .56f}, {.74f, .53f, .40f}, {.50f, .34f, .25f}};
  constexpr Rgb kHair[] = {{.20f, .14f, .10f}, {.48f, .34f, .18f}, {.13f, .13f, .14f}};
  constexpr Rgb kTrousers[] = {{.22f, .27f, .42f}, {.27f, .25f, .23f}, {.50f, .45f, .36f}};
  // No two people in a row look alike.
  const auto before = std::count_if(w.scene.bodies.begin(), w.scene.bodies.end(),
                                    [](const Body& body) { return body.mobility == Mobility::person; });
  const auto nth = static_cast<std::size_t>(before) + w.look;
  const Rgb skin = kSkins[nth % 3];
  Outfit outfit{};
  outfit.skin = w.plain(skin);
  outfit.lips = w.plain(skin * Rgb{.82f, .60f, .58f});
  outfit.eyes = w.plain({.95f, .95f, .93f});
  outfit.hair = w.tiled(grain(w.random.next(), 0.25), 0.4, 1, kHair[(nth + nth / 3) % 3]);
  outfit.shirt = w.tiled(cloth(w.random.next(), kShirts[nth % 5], static_cast<int>((nth + 1) % 3)), 1.0);
  outfit.trousers = w.tiled(cloth(w.random.next(), kTrousers[nth % 3], 0), 1.0);
  outfit.shoes = w.plain({.15f, .13f, .12f});
  return outfit;
}

std::array<Vec3, 2> hands_of(Arms arms, const Posture& p, double time_s, std::uint64_t seed) {
  const double hip = std::lerp(0.93, kSeatedHip, p.sitting), shoulder = hip + kTrunk - 0.04;
  std::array<Vec3, 2> hands;
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1 : -1;
    const double swing =
        0.10 - 0.36 * p.stride * std::sin(p.stride_phase + (side > 0 ? 0 : 3.14159265358979));
    const BandLimitedNoise a(hash(seed, i, 1), 0.25, 1.2), b(hash(seed, i, 2), 0.25, 1.2),
        c(hash(seed, i, 3), 0.25, 1.2);
    Vec3& hand = hands[static_cast<std::size_t>(i)];
    switch (arms) {
      case Arms::swing:
        hand = Vec3{side * 0.24, 0, shoulder} + 0.553 * down_and_forward(swing);
        break;
      case Arms::push:
        hand = {side * 0.17, -0.42, 1.04};
        break;
      case Arms::pick:
        hand = {side * 0.19, -0.46, 0.87};
        break;
      case Arms::carry:
        hand = {side * 0.19, -0.34, 1.02};
        break;
      case Arms::gesture:
        hand = {side * 0.20 + 0.06 * a.at(time_s), -0.30 + 0.05 * b.at(time_s),
                hip + 0.28 + 0.08 * c.at(time_s)};
        break;
      case Arms::rest:
        hand = {side * 0.13 + 0.01 * a.at(time_s), -0.30, hip + 0.13 + 0.01 * c.at(time_s)};
        break;
    }
  }
  return hands;
}

std::vector<Solid> body_of(const Posture& p, const Outfit& outfit) {
  // The lower foot stands on the floor.
  const double lowest = std::min(leg_of(p, 1).ankle.z, leg_of(p, -1).ankle.z);
  const Vec3 pelvis{0, 0, std::lerp(kSole - lowest, kSeatedHip, p.sitting)};
  const Vec3 spine{0, -std::sin(p.lean_rad), std::cos(p.lean_rad)};
  const Vec3 waist = pelvis + 0.12 * spine, chest = pelvis + 0.36 * spine, neck = pelvis + kTrunk * spine;
  std::vector<Solid> body;
  body.push_back(limb(pelvis + Vec3{-0.07, 0, 0.01}, pelvis + Vec3{0.07, 0, 0.01}, 0.105, 0.105,
                      outfit.trousers, 1, {0, 0, 1}));
  body.push_back(limb(waist + Vec3{0, 0, -0.03}, chest, 0.145, 0.175, outfit.shirt, 0.68));
  body.push_back(limb(chest + Vec3{-0.13, 0, 0.06}, chest + Vec3{0.13, 0, 0.06}, 0.085, 0.085, outfit.shirt,
                      1, {0, 0, 1}));
  add_head(body, p, outfit, neck);
  for (int i = 0; i < 2; ++i) {
    const int side = i == 0 ? 1 : -1;
    const Vec3 shoulder = neck + Vec3{side * kShoulderWidth, 0, 0} + -0.06 * spine;
    Vec3 hand = p.hands[static_cast<std::size_t>(i)];
    const Vec3 elbow = elbow_of(shoulder, hand, side);
    const Vec3 wrist = elbow + 0.86 * (hand - elbow);
    body.push_back(limb(shoulder, elbow, 0.058, 0.044, outfit.shirt));
    body.push_back(limb(elbow, wrist, 0.043, 0.031, outfit.skin));
    body.push_back(limb(wrist, hand + 0.12 * (hand - elbow), 0.034, 0.036, outfit.skin, 0.7));
  }
  add_legs(body, p, outfit, pelvis);
  return body;
}

}  // namespace sediment::synthetic
