#pragma once

#include "tools/synthesize/workshop.hpp"

namespace sediment::synthetic {

/// What hangs on the walls: posters, pin boards, a whiteboard, a clock, and a door, radiator, sockets.
void hang_fittings(Workshop& workshop);
/// On the walls of a bare room.
void hang_few_fittings(Workshop& workshop);

}  // namespace sediment::synthetic
