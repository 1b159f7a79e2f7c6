#include "tools/synthesize/plays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/synthesize/actors.hpp"
#include "tools/synthesize/room.hpp"

namespace sediment::synthetic {
namespace {

// Directions of a person's front.
constexpr double kToRight = std::numbers::pi / 2, kToLeft = -std::numbers::pi / 2,
                 kToDesks = std::numbers::pi, kToCamera = 0;

int add_chair(Workshop& w, const std::string& name, Rgb color, const Pose& pose = {}) {
  return w.add(name, "chair", true, moved(office_chair(w, color), pose));
}

CameraMotion before_desks(const Stage& stage) {
  return handheld(stage.motion_seed, {0.05, -1.35, 1.45}, 0, -0.22);
}

void add_walkers(Workshop& w) {
  add_chair(w, "chair", {.20f, .30f, .58f}, placed({-1.0, 1.12, 0}, std::numbers::pi + 0.3));
  add_person(w, "passer-by",
             {{0, -1.3, 0.15, kToRight},
              {3.2, 1.7, 0.2, kToRight},
              {4.2, 1.7, 0.2, kToDesks},
              {7.6, -1.6, 0.35, kToLeft},
              {8.4, -1.6, 0.35, kToDesks},
              {11.4, 1.2, 0.2, kToRight},
              {12.4, 1.2, 0.2, kToDesks},
              {15.4, -1.3, 0.15, kToLeft},
              {16, -1.3, 0.15, kToRight}});
  const auto pusher = add_person(w, "pusher",
                                 {{0, -0.75, 0.78, kToRight, Arms::push},
                                  {1, -0.75, 0.78, kToRight, Arms::push},
                                  {3.6, 0.35, 0.78, kToRight, Arms::push},
                                  {4.6, 0.30, 0.78, kToRight},
                                  {7, -1.1, 0.55, kToLeft},
                                  {8.5, -1.1, 0.55, kToCamera},
                                  {11, 0.30, 0.78, kToRight},
                                  {12, 0.35, 0.78, kToRight, Arms::push},
                                  {14.6, -0.75, 0.78, kToRight, Arms::push},
                                  {16, -0.75, 0.78, kToRight, Arms::push}});
  const int chair = add_chair(w, "pushed chair", {.16f, .48f, .46f});
  push_along(w.scene.bodies[static_cast<std::size_t>(chair)], pusher, placed({0, -0.62, 0}),
             {{1, 3.6}, {12, 14.6}});
}

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

}  // namespace

CameraMotion play_static(Stage stage) {
  furnish(stage.workshop, RoomStyle::furnished);
  add_chair(stage.workshop, "chair", {.20f, .30f, .58f}, placed({-1.0, 1.12, 0}, std::numbers::pi + 0.3));
  add_chair(stage.workshop, "chair", {.16f, .48f, .46f}, placed({0.8, 1.0, 0}, std::numbers::pi - 0.6));
  return before_desks(stage);
}

CameraMotion play_walking(Stage stage) {
  furnish(stage.workshop, RoomStyle::furnished);
  add_walkers(stage.workshop);
  return before_desks(stage);
}

CameraMotion play_rotation(Stage stage) {
  furnish(stage.workshop, RoomStyle::furnished);
  add_walkers(stage.workshop);
  return turning(stage.motion_seed, {0.05, -1.35, 1.4}, 0, -0.2);
}

CameraMotion play_sitting(Stage stage) {
  Workshop& w = stage.workshop;
  furnish(w, RoomStyle::furnished);
  const auto seat = [&](const std::string& name, Rgb color, double x, double y, double yaw) {
    add_chair(w, "chair of the " + name, color, placed({x, y, 0}, yaw));
    const Vec3 pelvis = placed({x, y, 0}, yaw) * Vec3{0, 0.06, 0};
    add_person(w, name,
               {{0, pelvis.x, pelvis.y, yaw, Arms::gesture, 1},
                {6, pelvis.x, pelvis.y, yaw, Arms::gesture, 1},
                {7, pelvis.x, pelvis.y, yaw, Arms::rest, 1},
                {9, pelvis.x, pelvis.y, yaw, Arms::rest, 1},
                {10, pelvis.x, pelvis.y, yaw, Arms::gesture, 1}});
  };
  seat("talker", {.20f, .30f, .58f}, -0.75, 0.75, 0.55);
  seat("listener", {.16f, .48f, .46f}, 0.75, 0.85, -0.65);
  return before_desks(stage);
}

CameraMotion play_carried_box(Stage stage) {
  Workshop& w = stage.workshop;
  furnish(w, RoomStyle::furnished);
  add_chair(w, "chair", {.20f, .30f, .58f}, placed({-1.35, 1.05, 0}, std::numbers::pi + 0.3));
  constexpr double kHalfHeight = 0.13;
  // From the left desk round the middle of the room to the right desk, and after a while back again.
  const auto carrier = add_person(w, "carrier",
                                  {{0, -0.33, 1.16, kToDesks, Arms::pick},
                                   {0.8, -0.33, 1.16, kToDesks, Arms::pick},
                                   {1.6, -0.33, 1.12, kToDesks, Arms::carry},
                                   {3.0, 0.1, 0.35, kToRight, Arms::carry},
                                   {4.4, 1.35, 0.5, kToRight, Arms::carry},
                                   {5.4, 1.37, 1.12, kToDesks, Arms::carry},
                                   {6.2, 1.37, 1.16, kToDesks, Arms::pick},
                                   {6.8, 1.37, 1.16, kToDesks, Arms::pick},
                                   {7.6, 1.37, 0.95, kToDesks},
                                   {10, -0.2, 0.3, kToLeft},
                                   {12, 1.37, 0.95, kToDesks},
                                   {12.8, 1.37, 1.16, kToDesks, Arms::pick},
                                   {13.4, 1.37, 1.16, kToDesks, Arms::pick},
                                   {14.2, 1.37, 1.12, kToDesks, Arms::carry},
                                   {15.8, 0.1, 0.35, kToLeft, Arms::carry},
                                   {17.2, -0.33, 1.12, kToDesks, Arms::carry},
                                   {18, -0.33, 1.16, kToDesks, Arms::pick}});
  const int carried = w.add("carried box", "box", true, carton(w, {0.37, 0.28, 2 * kHalfHeight}));
  carry_along(w.scene.bodies[static_cast<std::size_t>(carried)], carrier, placed({0, 0, -kHalfHeight}),
              {{0.8, 6.2}, {13.4, 18}});
  return handheld(stage.motion_seed, {0.4, -1.4, 1.45}, 0.03, -0.22);
}

// A pale room, a camera that rolls over to 80 degrees and back, and people who stand close before it while it
// does: in the middle second they hide most of the view.
CameraMotion play_crowd(Stage stage) {
  Workshop& w = stage.workshop;
  furnish(w, RoomStyle::pale);
  const double middle = stage.duration_s / 2, end = stage.duration_s;
  const double come = std::max(0.3, middle - 2), there = std::max(0.6, middle - 0.9), leave = middle + 0.9,
               gone = std::max(leave + 0.3, middle + 2);
  const double spots[4][2] = {{-0.42, -0.42}, {0.03, -0.55}, {0.48, -0.38}, {0.2, 0.05}};
  for (int k = 0; k < 4; ++k) {
    const double far_x = k % 2 == 0 ? -2.0 : 2.0, far_y = 0.1 + 0.2 * k,
                 heading = k % 2 == 0 ? kToRight : kToLeft;
    add_person(w, "visitor",
               {{0, far_x, far_y, heading},
                {come, far_x, far_y, heading},
                {there, spots[k][0], spots[k][1], kToDesks + 0.4 * k},
                {leave, spots[k][0] + 0.08, spots[k][1], kToDesks + 0.4 * k + 0.5},
                {gone, -far_x, far_y, heading},
                {std::max(end, gone) + 10, -far_x, far_y, heading},
                {std::max(end, gone) + 14, far_x, far_y, heading}});
  }
  const CameraMotion hand = handheld(stage.motion_seed, {0.05, -1.3, 1.4}, 0, -0.15);
  return [=](double t) {
    const double roll = 80 * std::numbers::pi / 180 * smooth_step((t - 0.1 * end) / (0.4 * end)) *
                        (1 - smooth_step((t - 0.5 * end) / (0.4 * end)));
    return hand(t) * rotation_from({0, 0, roll});
  };
}

// The camera swings to and fro along the wall: between the door and the radiator there is nearly nothing to
// see.
CameraMotion play_bare(Stage stage) {
  Workshop& w = stage.workshop;
  furnish(w, RoomStyle::bare);
  add_person(w, "passer-by",
             {{0, -2.4, 0.9, kToRight},
              {1.5, -2.4, 0.9, kToRight},
              {6, 2.3, 1.0, kToRight},
              {9, 2.3, 1.0, kToLeft},
              {14, -2.4, 0.9, kToLeft},
              {16, -2.4, 0.9, kToRight}});
  const CameraMotion hand = handheld(stage.motion_seed, {0.05, -0.95, 1.45}, 0, -0.2);
  return [=](double t) {
    constexpr double kPeriod = 11, kSwing = 0.45;  // seconds, radians
    return looking({}, kSwing * std::sin(2 * std::numbers::pi * t / kPeriod), 0, 0) *
           looking({}, 0, 0, 0).inverse() * hand(t);
  };
}

CameraMotion play_loop(Stage stage) {
  furnish(stage.workshop, RoomStyle::furnished);
  add_chair(stage.workshop, "chair", {.20f, .30f, .58f}, placed({-1.0, 1.12, 0}, std::numbers::pi + 0.3));
  add_chair(stage.workshop, "chair", {.16f, .48f, .46f}, placed({-0.6, -1.35, 0}, 0.4));
  const double duration = stage.duration_s;
  const CameraMotion sway = handheld(stage.motion_seed, {}, 0, 0);
  return [=](double t) {
    const double angle = 2 * std::numbers::pi * t / duration;
    // On a ring about the middle of the room, looking outward and ahead.
    Pose ring = looking({0.95 * std::sin(angle), 0.75 * std::cos(angle) - 0.15, 1.4}, angle + 0.35, -0.2, 0);
    const Pose small = sway(t);
    ring.translation = ring.translation + 0.3 * small.translation;
    return ring * looking({}, 0, 0, 0).inverse() *
           interpolate(looking({}, 0, 0, 0), Pose{small.rotation, {}}, 0.5);
  };
}

// The view jumps during the blackout: the camera is carried to the side and turned while nothing is seen.
CameraMotion play_kidnapped(Stage stage) {
  const CameraMotion hand = play_static(stage);
  const double middle = stage.duration_s / 2, half = 0.1 * stage.duration_s;
  return [=](double t) {
    const double moved_by = smooth_step((t - middle + half) / (2 * half));
    Pose pose = hand(t) * rotation_from({0, 0.3 * moved_by, 0});
    pose.translation = pose.translation + moved_by * Vec3{-0.55, 0.25, 0.1};
    return pose;
  };
}

}  // namespace sediment::synthetic
