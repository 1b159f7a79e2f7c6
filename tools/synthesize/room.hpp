#pragma once

#include "tools/synthesize/workshop.hpp"

namespace sediment::synthetic {

/// How the room looks.
struct RoomStyle {
  bool bare = false;  ///< low texture: pale walls without posters, plain floor, few things
};

/// Walls, floor, ceiling, lamps, posters and all furniture that never moves: a room of 6 x 5 x 2.7 m around
/// the origin of the floor, with desks along the wall at +y.
void furnish(Workshop& workshop, const RoomStyle& style);

// Furniture in frames of its own: origin on the floor below its middle, front towards -y.
std::vector<Solid> office_chair(Workshop& workshop, Rgb seat);
std::vector<Solid> carton(Workshop& workshop, Vec3 size);

}  // namespace sediment::synthetic
