#include "stages/project2d/up_hint.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "pipeline/contract/errors.hpp"

namespace sediment::project2d {

UpHint up_from_trajectory(const Trajectory& trajectory) {
  Vec3 sum;
  for (const StampedPose& pose : trajectory) sum = sum + pose.world_from_camera.rotate(kUpwardOfCamera);
  const double length = norm(sum);
  if (!(length > 0.1 * static_cast<double>(trajectory.size())))
    throw std::runtime_error(
        "the trajectory says nothing about the upward direction: " + std::to_string(trajectory.size()) +
        " poses whose upward image directions cancel out; give `up` or `ground`");
  return {sum / length, 45, "trajectory"};
}

UpHint parse_up(const std::string& text) {
  std::istringstream stream(text);
  Vec3 up;
  std::string more;
  stream >> up.x >> up.y >> up.z;
  const double length = norm(up);
  if (!stream || stream >> more || !(length > 0) || !std::isfinite(length))
    throw contract::UsageError("up: expected \"x y z\", a direction other than zero, found \"" + text + "\"");
  return {up / length, 20, "up is given"};
}

}  // namespace sediment::project2d
