#include "stages/carve/point_blocks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace sediment;
using namespace sediment::carve;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

LabelledCloud random_cloud(int size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> along(-4, 4);
  LabelledCloud cloud;
  for (int i = 0; i < size; ++i) {
    LabelledPoint point{.x = along(random), .y = along(random), .z = along(random)};
    point.instance = static_cast<std::uint32_t>(i);
    cloud.push_back(point);
  }
  cloud[7].x = kNaN;
  cloud[8].y = kInf;
  cloud[9].z = 1e6F;
  return cloud;
}

}  // namespace

TEST_CASE("blocks hold every point of the cloud once") {
  const LabelledCloud cloud = random_cloud(20000);
  const PointBlocks sorted = blocks_of(cloud);
  std::vector<char> seen(cloud.size());
  std::size_t next = 0;
  for (const Block& block : sorted.blocks) {
    CHECK(block.begin == next);
    next = block.end;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      CHECK(sorted.points[i].instance == sorted.order[i]);
      seen[sorted.order[i]] = 1;
    }
  }
  CHECK(next == cloud.size());
  CHECK(std::count(seen.begin(), seen.end(), 1) == 20000);
  CHECK(blocks_of({}).blocks.empty());
}

TEST_CASE("whatever a camera sees lies in a block that may be in sight, and most others do not") {
  Camera camera{640, 480, 517, 516, 318, 255, {}, 5000};
  if (GENERATE(false, true)) camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  const PointBlocks sorted = blocks_of(random_cloud(20000));
  const Frustum frustum = frustum_of(camera, 0.4, 5);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  std::size_t in_blocks = 0, in_sight = 0;
  for (int i = 0; i < 20; ++i) {
    const Pose pose = pose_from({number(random), number(random), number(random), number(random)},
                                {number(random), number(random), number(random)});
    for (const Block& block : sorted.blocks) {
      const bool may = block.may_be_in(frustum, pose);
      in_blocks += may ? block.end - block.begin : 0;
      for (std::size_t k = block.begin; k < block.end; ++k) {
        const LabelledPoint& point = sorted.points[k];
        const Vec3 p = pose * Vec3{point.x, point.y, point.z};
        if (!(p.z >= 0.4 && p.z <= 5) || std::abs(p.x) > p.z || std::abs(p.y) > p.z) continue;
        const Pixel at = camera.project(p);
        if (!(at.u > -0.5 && at.v > -0.5 && at.u < 639.5 && at.v < 479.5)) continue;
        ++in_sight;
        REQUIRE(may);
      }
    }
  }
  CHECK(in_sight > 10000);
  CHECK(in_blocks < 2 * in_sight);
}
