#include "stages/project2d/up_hint.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "pipeline/artifacts/text_table.hpp"
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

std::optional<UpHint> up_from_accelerometer(const std::filesystem::path& file, const Trajectory& trajectory,
                                            const UpHint& by_posture) {
  constexpr double kLongestGap_s = 0.2;
  constexpr int kLeastReadings = 10;
  Vec3 sum;
  int readings = 0;
  read_rows(file, [&](const TextRow& row) {
    if (row.columns.size() != 4)
      throw std::runtime_error("expected stamp ax ay az, found " + std::to_string(row.columns.size()) +
                               " columns");
    const double stamp_s = expect_number(row.columns[0], "the stamp");
    const Vec3 felt{expect_number(row.columns[1], "ax"), expect_number(row.columns[2], "ay"),
                    expect_number(row.columns[3], "az")};
    if (const auto pose = pose_at(trajectory, stamp_s, kLongestGap_s)) {
      sum = sum + pose->rotate(felt);
      ++readings;
    }
  });
  const double length = norm(sum);
  if (readings < kLeastReadings || !(length > 0)) return std::nullopt;
  const double sign = dot(sum, by_posture.up) < 0 ? -1 : 1;
  return UpHint{sign * sum / length, 10, "accelerometer"};
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
