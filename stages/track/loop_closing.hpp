#pragma once

#include "stages/track/dense_frame.hpp"
#include "stages/track/map.hpp"
#include "stages/track/pinhole.hpp"

namespace sediment::track {

/// What closing loops has done.
struct LoopClosing {
  int loops = 0;   ///< pairs of keyframes that were found to show one place
  int joined = 0;  ///< segments that became part of an earlier one
};

/// Finds keyframes that show a place which another keyframe, that shares no landmarks with it nor with its
/// neighbours, shows too: by their looks (PlaceIndex), then by the pose that descriptors agree on, then by
/// the landmarks around it, then by the surfaces of both views. Segments that a pair connects are joined; all
/// keyframes are moved so that the pairs fit (pose graph), landmarks seen on both sides become one. The map
/// wants an adjustment of everything afterwards.
LoopClosing close_loops(Map& map, const Pinhole& pinhole, const DenseCamera& dense_camera,
                        double depth_noise);

}  // namespace sediment::track
