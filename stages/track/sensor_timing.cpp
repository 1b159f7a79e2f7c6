#include "stages/track/sensor_timing.hpp"

namespace sediment::track {

Pose moved(const Motion& motion, double duration_s) {
  Pose pose = rotation_from(duration_s * motion.angular_rad_s);
  pose.translation = duration_s * motion.linear_m_s;
  return pose;
}

std::vector<Motion> motions_of(const std::vector<double>& stamps_s,
                               const std::vector<const Pose*>& world_from_camera, double max_gap_s) {
  std::vector<Motion> motions(stamps_s.size());
  const auto near = [&](std::size_t a, std::size_t b) {
    return world_from_camera[a] && world_from_camera[b] && stamps_s[b] - stamps_s[a] <= max_gap_s;
  };
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const std::size_t before = i > 0 && near(i - 1, i) ? i - 1 : i;
    const std::size_t after = i + 1 < motions.size() && near(i, i + 1) ? i + 1 : i;
    if (before == after) continue;
    const double duration_s = stamps_s[after] - stamps_s[before];
    const Pose step = world_from_camera[before]->inverse() * *world_from_camera[after];
    const Pose now_from_world = world_from_camera[i]->inverse();
    motions[i].angular_rad_s = rotation_vector(step) / duration_s;
    motions[i].linear_m_s = now_from_world.rotate(world_from_camera[after]->translation -
                                                  world_from_camera[before]->translation) /
                            duration_s;
  }
  return motions;
}

}  // namespace sediment::track
