#pragma once

#include "tools/synthesize/room.hpp"

namespace sediment::synthetic {

/// Desks with screens, keyboards, cups and books, shelf, cabinet, boxes, door, plant.
void place_furniture(Workshop& workshop, RoomStyle style);

}  // namespace sediment::synthetic
