#pragma once

#include "tools/synthesize/workshop.hpp"

namespace sediment::synthetic {

/// How the room looks.
enum class RoomStyle {
  furnished,  ///< posters on lively walls, desks full of things
  pale,       ///< the same furniture with nothing on it, walls of low contrast with nothing on them
  bare,       ///< white walls, plain floor and ceiling, hardly any thing
};

/// Walls, floor, ceiling, lamps, posters and all furniture that never moves: a room of 6 x 5 x 2.7 m around
/// the origin of the floor, with desks along the wall at +y.
void furnish(Workshop& workshop, RoomStyle style);

// Furniture in frames of its own: origin on the floor below its middle, front towards -y.
std::vector<Solid> office_chair(Workshop& workshop, Rgb seat);
std::vector<Solid> carton(Workshop& workshop, Vec3 size);

}  // namespace sediment::synthetic
