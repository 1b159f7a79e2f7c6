#include "tools/synthesize/actors.hpp"

#include <cmath>
#include <functional>

namespace sediment::synthetic {
namespace {

/// The time of the errand that decides where the thing is: now during a ride, else the end of the ride
/// before.
double deciding_time(double t, const std::vector<Ride>& rides) {
  double rest = rides.back().to_s;
  for (const Ride& ride : rides) {
    if (t > ride.from_s && t < ride.to_s) return t;
    if (t >= ride.to_s) rest = ride.to_s;
  }
  return rest;
}

void ride_along(Body& body, const SharedErrand& errand, std::vector<Ride> rides,
                std::function<Pose(double)> world_from_body) {
  body.mobility = Mobility::movable;
  body.world_from_body = [=](double time_s) {
    return world_from_body(deciding_time(std::fmod(time_s, errand->period_s()), rides));
  };
  body.moving = [=](double time_s) {
    const double t = std::fmod(time_s, errand->period_s());
    for (const Ride& ride : rides)
      if (t > ride.from_s && t < ride.to_s) return true;
    return false;
  };
}

}  // namespace

SharedErrand add_person(Workshop& w, const std::string& name, std::vector<Step> steps) {
  const auto errand = std::make_shared<const Errand>(std::move(steps), w.random.next());
  const Outfit outfit = dress(w);
  const auto solids_at = [=](double time_s) {
    return moved(body_of(errand->posture(time_s), outfit), errand->world_from_person(time_s));
  };
  Body& body = w.scene.bodies[static_cast<std::size_t>(w.add(name, "person", true, solids_at(0)))];
  body.mobility = Mobility::person;
  body.articulated = solids_at;
  return errand;
}

void push_along(Body& body, const SharedErrand& errand, const Pose& person_from_body,
                std::vector<Ride> rides) {
  ride_along(body, errand, std::move(rides),
             [=](double t) { return errand->world_from_person(t) * person_from_body; });
}

void carry_along(Body& body, const SharedErrand& errand, const Pose& hands_from_body,
                 std::vector<Ride> rides) {
  ride_along(body, errand, std::move(rides), [=](double t) {
    const auto hands = errand->posture(t).hands;
    return errand->world_from_person(t) * placed(0.5 * (hands[0] + hands[1])) * hands_from_body;
  });
}

}  // namespace sediment::synthetic
