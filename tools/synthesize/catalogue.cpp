#include "tools/synthesize/catalogue.hpp"

#include <memory>
#include <numbers>
#include <stdexcept>

#include "tools/synthesize/errand.hpp"
#include "tools/synthesize/room.hpp"

namespace sediment::synthetic {
namespace {

constexpr double kPi = std::numbers::pi;

void add_person(Workshop& w, const std::string& name, const std::shared_ptr<const Errand>& errand) {
  const Outfit outfit = dress(w);
  const auto solids_at = [=](double time_s) {
    return moved(body_of(errand->posture(time_s), outfit), errand->world_from_person(time_s));
  };
  const int body = w.add(name, "person", true, solids_at(0));
  w.scene.bodies[static_cast<std::size_t>(body)].mobility = Mobility::person;
  w.scene.bodies[static_cast<std::size_t>(body)].articulated = solids_at;
}

/// A time in which a thing goes with a person; `person_from_body` is fixed meanwhile.
struct Ride {
  double from_s, to_s;
};
void let_ride(Body& body, const std::shared_ptr<const Errand>& errand, Pose person_from_body,
              std::vector<Ride> rides) {
  body.mobility = Mobility::movable;
  const auto within = [=](double time_s) {
    const double t = std::fmod(time_s, errand->period_s());
    for (const Ride& ride : rides)
      if (t > ride.from_s && t < ride.to_s) return t;
    // At rest where the last ride ended.
    double rest = rides.back().to_s;
    for (const Ride& ride : rides)
      if (t >= ride.to_s) rest = ride.to_s;
    return rest;
  };
  body.world_from_body = [=](double time_s) {
    return errand->world_from_person(within(time_s)) * person_from_body;
  };
  body.moving = [=](double time_s) {
    const double t = std::fmod(time_s, errand->period_s());
    for (const Ride& ride : rides)
      if (t > ride.from_s && t < ride.to_s) return true;
    return false;
  };
}

void walk_and_push(Workshop& w) {
  const double right = kPi / 2, left = -kPi / 2;
  const auto passer = std::make_shared<const Errand>(std::vector<Step>{{0, -1.3, 0.15, right},
                                                                       {3.2, 1.7, 0.2, right},
                                                                       {4.2, 1.7, 0.2, kPi},
                                                                       {7.6, -1.6, 0.35, left},
                                                                       {8.4, -1.6, 0.35, kPi},
                                                                       {11.4, 1.2, 0.2, right},
                                                                       {12.4, 1.2, 0.2, kPi},
                                                                       {15.4, -1.3, 0.15, left},
                                                                       {16, -1.3, 0.15, right}},
                                                     w.random.next());
  add_person(w, "passer-by", passer);
  const auto pusher = std::make_shared<const Errand>(std::vector<Step>{{0, -0.75, 0.78, right, Arms::push},
                                                                       {1, -0.75, 0.78, right, Arms::push},
                                                                       {3.6, 0.35, 0.78, right, Arms::push},
                                                                       {4.6, 0.30, 0.78, right},
                                                                       {7, -1.1, 0.55, left},
                                                                       {8.5, -1.1, 0.55, 0},
                                                                       {11, 0.30, 0.78, right},
                                                                       {12, 0.35, 0.78, right, Arms::push},
                                                                       {14.6, -0.75, 0.78, right, Arms::push},
                                                                       {16, -0.75, 0.78, right, Arms::push}},
                                                     w.random.next());
  add_person(w, "pusher", pusher);
  const int chair = w.add("pushed chair", "chair", true, office_chair(w, {.16f, .48f, .46f}));
  let_ride(w.scene.bodies[static_cast<std::size_t>(chair)], pusher, placed({0, -0.62, 0}),
           {{1, 3.6}, {12, 14.6}});
}

Play begin(Workshop&& w, CameraMotion motion) {
  return {std::move(w.scene), std::move(motion), 1, 1};
}

}  // namespace

const std::vector<Title>& titles() {
  static const std::vector<Title> all{
      {"walking", "two people walk through the view, one pushes a chair and later pulls it back", 300},
      {"static", "nobody there: a hand-held camera before the desks", 300},
  };
  return all;
}

Play stage_play(const std::string& name, std::uint64_t seed, double /*duration_s*/, double texel_m) {
  Workshop w(hash(seed, 1), texel_m);
  furnish(w, {});
  const CameraMotion before_desks = handheld(hash(seed, 2), {0.05, -1.35, 1.45}, 0.0, -0.22);
  if (name == "static") return begin(std::move(w), before_desks);
  if (name == "walking") {
    walk_and_push(w);
    return begin(std::move(w), before_desks);
  }
  throw std::invalid_argument("there is no scene '" + name + "'");
}

}  // namespace sediment::synthetic
