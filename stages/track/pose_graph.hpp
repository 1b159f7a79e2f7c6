#pragma once

#include <array>
#include <vector>

#include "pipeline/scene/pose.hpp"

namespace sediment::track {

/// Camera poses and what is known of pairs of them.
struct PoseGraph {
  struct Edge {
    int from_idx = 0, to_idx = 0;  ///< into the poses
    Pose to_from_from;             ///< camera to camera
    double weight = 1;             ///< relative to the others
  };
  std::vector<Pose> camera_from_world;
  std::vector<char> fixed;  ///< one a pose; at least one in every connected part
  std::vector<Edge> edges;
};

/// The poses that agree best with all edges together (Ceres), in place. A millimetre counts as much as a
/// milliradian.
void relax(PoseGraph& graph);

}  // namespace sediment::track
