#include "tools/evaluate-map/map_alignment.hpp"

#include <stdexcept>

#include "tools/alignment/alignment.hpp"

namespace sediment::tools {

Pose truth_from_map(const TrueSequence& truth, const Trajectory& trajectory) {
  const Camera& camera = truth.sequence.camera();
  const double right = camera.width - 1.0, bottom = camera.height - 1.0;
  std::vector<Vec3> seen;
  for (const Pixel pixel : {Pixel{0, 0}, {right, 0}, {0, bottom}, {right, bottom}, {right / 2, bottom / 2}})
    seen.push_back(camera.back_project(pixel, 2));
  std::vector<Vec3> true_points, points;
  for (std::size_t i = 0; i < truth.sequence.size(); ++i) {
    const auto pose_idx = nearest_pose(trajectory, truth.sequence.entry(i).stamp_s, 1e-4);
    if (!pose_idx || !truth.world_from_camera[i]) continue;
    for (const Vec3& point : seen) {
      true_points.push_back(*truth.world_from_camera[i] * point);
      points.push_back(trajectory[*pose_idx].world_from_camera * point);
    }
  }
  if (points.empty())
    throw std::runtime_error("the trajectory that the map was made with has no pose of a frame of the truth");
  return align(true_points, points, false).value().truth_from_estimate;
}

}  // namespace sediment::tools
