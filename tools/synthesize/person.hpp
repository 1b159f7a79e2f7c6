#pragma once

#include <array>
#include <vector>

#include "tools/synthesize/workshop.hpp"

namespace sediment::synthetic {

/// What a person wears: indices of materials.
struct Outfit {
  int skin, hair, shirt, trousers, shoes, lips, eyes;
};
Outfit dress(Workshop& workshop);

/// What a person does with the arms.
enum class Arms { swing, push, pick, carry, gesture, rest };

/// A person's body at one time, in a frame on the floor below the pelvis: front is -y, z is up.
struct Posture {
  double stride_phase = 0;  ///< radians; a full turn is two steps
  double stride = 0;        ///< 0 stands .. 1 walks at full pace
  double sitting = 0;       ///< 0 stands .. 1 sits on a seat of 0.51 m
  double lean_rad = 0;      ///< of the trunk, forward
  double turn_rad = 0;      ///< of the head, to the left
  double nod_rad = 0;
  std::array<Vec3, 2> hands{};  ///< left, right
};

/// Where the hands are when the arms do something.
std::array<Vec3, 2> hands_of(Arms arms, const Posture& posture, double time_s, std::uint64_t seed);

/// The body's pieces, always the same number in the same order.
std::vector<Solid> body_of(const Posture& posture, const Outfit& outfit);

}  // namespace sediment::synthetic
