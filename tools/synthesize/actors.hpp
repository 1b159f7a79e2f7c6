#pragma once

#include <memory>
#include <string>

#include "tools/synthesize/errand.hpp"

namespace sediment::synthetic {

using SharedErrand = std::shared_ptr<const Errand>;

/// A person in clothes of its own who goes about an errand.
SharedErrand add_person(Workshop& workshop, const std::string& name, std::vector<Step> steps);

/// A time of an errand in which a thing goes with the person.
struct Ride {
  double from_s, to_s;
};

/// Makes a body go with a person: fixed to the person's frame (a chair that is pushed) or to the middle
/// between the hands (a box that is carried). Between rides it rests where the last one left it.
void push_along(Body& body, const SharedErrand& errand, const Pose& person_from_body,
                std::vector<Ride> rides);
void carry_along(Body& body, const SharedErrand& errand, const Pose& hands_from_body,
                 std::vector<Ride> rides);

}  // namespace sediment::synthetic
