#include "stages/project2d/map_input.hpp"

#include <octomap/ColorOcTree.h>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/octree.hpp"
#include "pipeline/artifacts/sequence.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "stages/project2d/free_columns.hpp"

namespace sediment::project2d {

MapInput read_map_input(const std::optional<std::filesystem::path>& cloud,
                        const std::optional<std::filesystem::path>& octree) {
  MapInput input;
  if (octree) input.tree = read_octree(*octree);
  input.cloud = cloud ? read_cloud(*cloud) : occupied_cells(*input.tree, *octree);
  input.labels = read_cloud_labels(cloud ? *cloud : *octree);
  return input;
}

UpHint read_up(const std::filesystem::path& trajectory,
               const std::optional<std::filesystem::path>& sequence) {
  const Trajectory poses = read_trajectory(trajectory);
  const UpHint by_posture = up_from_trajectory(poses);
  if (!sequence) return by_posture;
  const auto file = Sequence::open(*sequence).accelerometer();
  return file ? up_from_accelerometer(*file, poses, by_posture).value_or(by_posture) : by_posture;
}

}  // namespace sediment::project2d
