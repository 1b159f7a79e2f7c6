#include "tests/stages/project2d/test_rooms.hpp"

#include <numbers>
#include <random>

namespace sediment::test {
namespace {

class Surfaces {
 public:
  Surfaces(const Pose& world_from_room, std::uint32_t seed) : pose_(world_from_room), random_(seed) {}

  /// A parallelogram, sampled with 2000 points a square metre.
  void add(Vec3 corner, Vec3 a, Vec3 b) {
    const Vec3 normal = normalized(cross(a, b));
    const auto count = static_cast<int>(2000 * norm(cross(a, b)));
    for (int i = 0; i < count; ++i) {
      const Vec3 p = pose_ * (corner + share_(random_) * a + share_(random_) * b + noise_(random_) * normal);
      LabelledPoint point;
      point.x = static_cast<float>(p.x);
      point.y = static_cast<float>(p.y);
      point.z = static_cast<float>(p.z);
      cloud.push_back(point);
    }
  }

  LabelledCloud cloud;

 private:
  Pose pose_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> share_{0, 1};
  std::normal_distribution<double> noise_{0, 0.005};
};

}  // namespace

LabelledCloud test_room(double floor_depth_m, const Pose& world_from_room, std::uint32_t seed) {
  Surfaces room(world_from_room, seed);
  room.add({0, 0, 0}, {5, 0, 0}, {0, floor_depth_m, 0});
  room.add({0, 4, 0}, {5, 0, 0}, {0, 0, 2.5});
  room.add({0, 0, 0}, {0, 4, 0}, {0, 0, 2.5});
  room.add({2, 2, 0.5}, {0.6, 0, 0}, {0, 0.6, 0});
  room.add({2, 2, 0}, {0.6, 0, 0}, {0, 0, 0.5});
  return room.cloud;
}

Pose room_from_test_camera(double pitch_down_deg) {
  const Pose level{{1, 0, 0, 0, 0, 1, 0, -1, 0}, {2.5, 0.2, 1.2}};  // x right, y down, z along the room's y
  return level * rotation_from({-pitch_down_deg * std::numbers::pi / 180, 0, 0});
}

LabelledCloud test_desk(const Pose& world_from_room, std::uint32_t seed) {
  Surfaces desk(world_from_room, seed);
  desk.add({1, 1, 0.7}, {2, 0, 0}, {0, 1, 0});
  desk.add({1.2, 1.6, 0.75}, {0.5, 0, 0}, {0, 0, 0.35});
  desk.add({2.2, 1.7, 0.75}, {0.5, 0, 0}, {0, 0, 0.35});
  desk.add({1.5, 1.3, 0.1}, {0.6, 0, 0}, {0, 0, 0.55});
  return desk.cloud;
}

}  // namespace sediment::test
