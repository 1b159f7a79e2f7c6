#pragma once

#include <cstdint>

#include "pipeline/scene/labelled_point.hpp"
#include "pipeline/scene/pose.hpp"

namespace sediment::test {

/// Surfaces of a room of 5 x 4 x 2.5 m with the floor in z = 0, 5 mm of noise: floor, two walls, a box of 0.6
/// m whose top is 0.5 m high. `floor_depth_m`: how much of the floor along y is seen. Given in the world
/// frame.
LabelledCloud test_room(double floor_depth_m, const Pose& world_from_room, std::uint32_t seed);

/// A camera in the room 1.2 m above the floor, looking along the room's y and a little down; optical axes.
Pose room_from_test_camera(double pitch_down_deg);

/// A desk top at 0.7 m of 2 x 1 m with things on it and a few below, no floor.
LabelledCloud test_desk(const Pose& world_from_room, std::uint32_t seed);

}  // namespace sediment::test
