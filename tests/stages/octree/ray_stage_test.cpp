#include <octomap/ColorOcTree.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/octree.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/synthetic/synthetic_sequence.hpp"

using namespace sediment;
namespace fs = std::filesystem;

namespace {

/// A few seconds of a walking scene, with its true poses, true dynamic masks and true static surface.
struct Scene {
  test::TemporaryFolder folder;
  Trajectory trajectory;

  Scene() {
    test::write_synthetic_sequence(folder / "seq", {.frames = 12, .rate_hz = 4});
    fs::create_directories(folder / "track");
    trajectory = read_tum_trajectory(folder / "seq/groundtruth.txt");
    write_tum_trajectory(folder / "track/trajectory.txt", trajectory);
  }
  std::string cloud() const { return "--cloud '" + (folder / "seq/truth/static_cloud").string() + "' "; }
  std::string rays() const {
    return "--sequence '" + (folder / "seq/sequence.yaml").string() + "' --trajectory '" +
           (folder / "track").string() + "' --dynamic '" + (folder / "seq/truth/dynamic").string() + "' ";
  }
  test::Outcome run(const std::string& arguments, const std::string& out) const {
    return test::run_program("octree", arguments + " --out '" + (folder / out).string() + "'");
  }
};

}  // namespace

TEST_CASE(
    "with a sequence the stage octree finds the air before the cameras free, and the cloud stays occupied") {
  const Scene scene;
  const test::Outcome done = scene.run(scene.cloud() + scene.rays(), "out");
  INFO(done.output);
  REQUIRE(done.code == 0);
  const auto tree = read_octree(scene.folder / "out");
  for (const StampedPose& pose : scene.trajectory) {
    const Vec3 ahead = pose.world_from_camera * Vec3{0, 0, 0.3};
    const auto* node = tree->search(ahead.x, ahead.y, ahead.z);
    REQUIRE(node != nullptr);
    CHECK_FALSE(tree->isNodeOccupied(node));
  }
  for (const LabelledPoint& point : read_cloud(scene.folder / "seq/truth/static_cloud")) {
    const auto* node = tree->search(point.x, point.y, point.z);
    REQUIRE(node != nullptr);
    REQUIRE(tree->isNodeOccupied(node));
  }
  std::size_t occupied = 0;
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf)
    occupied += tree->isNodeOccupied(*leaf) ? 1 : 0;
  CHECK(read_leaf_labels(scene.folder / "out").size() == occupied);
}

TEST_CASE("the stage octree with rays writes equal bytes with 1, 2 and 4 threads") {
  const Scene scene;
  const std::string more = GENERATE("--occupied rays", "--occupied cloud --label-fusion bayes --color label");
  for (const char* threads : {"1", "2", "4"})
    REQUIRE(scene.run(scene.cloud() + scene.rays() + more + " --threads " + threads, threads).code == 0);
  const auto id = [&](const char* name) { return contract::read_manifest(scene.folder / name).id(); };
  CHECK(id("1") == id("2"));
  CHECK(id("1") == id("4"));
}

TEST_CASE("the stage octree refuses half of what rays need, and fails where no frame has a pose") {
  const Scene scene;
  const std::string sequence = "--sequence '" + (scene.folder / "seq/sequence.yaml").string() + "' ";
  CHECK(scene.run(scene.cloud() + sequence, "out").code == 2);
  CHECK(scene.run(scene.cloud() + "--occupied rays", "out").code == 2);
  CHECK(scene.run(scene.cloud() + scene.rays() + "--ray-min-m 6", "out").code == 2);
  write_tum_trajectory(scene.folder / "track/trajectory.txt", {{"1.5", 1.5, {}}});
  const test::Outcome lost = scene.run(scene.cloud() + scene.rays(), "out");
  CHECK(lost.code == 1);
  CHECK_THAT(lost.output, Catch::Contains("no frame of the sequence has a pose"));
}
