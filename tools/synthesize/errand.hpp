#pragma once

#include <vector>

#include "tools/synthesize/person.hpp"

namespace sediment::synthetic {

/// Where a person is and what it does at one time of its errand.
struct Step {
  double time_s;
  double x_m, y_m;
  double yaw_rad;  ///< turn of the front, which is -y at 0
  Arms arms = Arms::swing;
  double sitting = 0;
};

/// A person's way through the room, repeated for ever: the last step must equal the first. Between two steps
/// it moves smoothly, starting and ending at rest.
class Errand {
 public:
  Errand(std::vector<Step> steps, std::uint64_t seed);

  Pose world_from_person(double time_s) const;
  Posture posture(double time_s) const;
  double period_s() const { return steps_.back().time_s; }

 private:
  struct Between {
    const Step *from, *to;
    double fraction;  ///< of the way, eased
    double pace_m_s;  ///< along the front, negative = backwards
    double walked_m;  ///< since the errand's start
  };
  Between between(double time_s) const;

  std::vector<Step> steps_;
  std::vector<double> walked_m_;  ///< at each step
  std::uint64_t seed_;
};

}  // namespace sediment::synthetic
