// The stages that make the map, on clouds that nobody wants: the right answer or a clear word, never a crash.
#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiny_sequence.hpp"

using namespace sediment;
namespace fs = std::filesystem;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

/// A folder with a cloud, and the sequence of a wall that carve looks at.
struct Workplace {
  test::TemporaryFolder folder;

  explicit Workplace(const LabelledCloud& cloud) {
    for (const char* name : {"in", "track"}) fs::create_directories(folder / name);
    write_cloud(folder / "in", cloud, default_labels(), PcdEncoding::binary);
    const test::TinySequence sequence = test::tiny_sequence();
    test::write_sequence(folder / "sequence", sequence);
    std::vector<FrameTracking> tracking;
    for (const StampedPose& pose : sequence.groundtruth)
      tracking.push_back({pose.stamp, TrackingState::tracked, true, 1, 1, 0});
    write_trajectory(folder / "track", sequence.groundtruth, tracking);
  }

  std::string path(const std::string& name) const { return "'" + (folder / name).string() + "' "; }

  test::Outcome run(const std::string& stage, const std::string& more, const std::string& out = "out") const {
    fs::remove_all(folder / out);
    std::string inputs = "--cloud " + path("in");
    if (stage == "carve")
      inputs += "--sequence " + path("sequence/sequence.yaml") + "--trajectory " + path("track");
    return test::run_program(stage, inputs + more + " --out " + path(out));
  }

  LabelledCloud result() const { return read_cloud(folder / "out"); }
};

LabelledPoint at(float x, float y, float z) {
  return {.x = x, .y = y, .z = z, .r = 7, .label = 56};
}

/// A wall at 2 m with some points that are no numbers.
LabelledCloud wall_with_holes() {
  LabelledCloud cloud;
  for (int y = -20; y < 20; ++y)
    for (int x = -20; x < 20; ++x)
      cloud.push_back(at(0.02F * static_cast<float>(x), 0.02F * static_cast<float>(y), 2));
  cloud[3].x = kNan;
  cloud[77].z = kInf;
  cloud[500].y = -kInf;
  return cloud;
}

}  // namespace

TEST_CASE(
    "an empty cloud stays empty in sor, voxel and carve, and is a clear error in octree and project2d") {
  const Workplace place({});
  for (const char* stage : {"sor", "voxel", "carve"}) {
    INFO(stage);
    REQUIRE(place.run(stage, "").code == 0);
    CHECK(place.result().empty());
  }
  const test::Outcome octree = place.run("octree", "");
  CHECK(octree.code == 1);
  CHECK_THAT(octree.output, Catch::Contains("no finite point among 0"));
  const test::Outcome grid = place.run("project2d", "");
  CHECK(grid.code == 1);
  CHECK_THAT(grid.output, Catch::Contains("no ground found") && Catch::Contains("give the plane by hand"));
  CHECK_FALSE(fs::exists(place.folder / "out"));
}

TEST_CASE("one point, and many at one place, go through every stage") {
  const std::size_t count = GENERATE(1u, 500u);
  const Workplace place(LabelledCloud(count, at(0.013F, -0.02F, 2)));
  for (const char* stage : {"sor", "carve"}) {
    INFO(stage);
    REQUIRE(place.run(stage, "").code == 0);
    CHECK(place.result().size() == count);
  }
  REQUIRE(place.run("voxel", "").code == 0);
  REQUIRE(place.result().size() == 1);
  CHECK(place.result()[0].x == 0.013F);
  CHECK(place.result()[0].label == 56);
  CHECK(place.run("octree", "").code == 0);
  CHECK(place.run("project2d", "").code == 1);
  CHECK(place.run("project2d", "--ground '0 0 1 -1.5'").code == 0);
}

TEST_CASE("points that are no numbers go, all others are as if they had never been") {
  const LabelledCloud dirty = wall_with_holes();
  LabelledCloud clean;
  for (const LabelledPoint& p : dirty)
    if (std::isfinite(p.x + p.y + p.z)) clean.push_back(p);
  REQUIRE(clean.size() == dirty.size() - 3);
  const Workplace place(dirty), without(clean);
  for (const char* stage : {"sor", "voxel"}) {
    INFO(stage);
    REQUIRE(place.run(stage, "").code == 0);
    REQUIRE(without.run(stage, "").code == 0);
    CHECK(place.result() == without.result());
  }
  CHECK(place.run("carve", "").code == 0);
  CHECK(place.run("octree", "").code == 0);
  CHECK(place.run("project2d", "--ground '0 1 0 1'").code == 0);

  const Workplace nothing({at(kNan, 0, 0), at(0, kInf, 0)});
  CHECK(nothing.run("sor", "").code == 0);
  CHECK(nothing.run("voxel", "").code == 0);
  CHECK(nothing.run("carve", "").code == 0);
  CHECK(nothing.run("octree", "").code == 1);
  CHECK(nothing.run("project2d", "--ground '0 1 0 1'").code == 1);
}

TEST_CASE(
    "coordinates of a million metres are kept where there is room for them, else refused with the reason") {
  LabelledCloud cloud = wall_with_holes();
  cloud.push_back(at(1e6F, -1e6F, 1e6F));
  const Workplace place(cloud);
  REQUIRE(place.run("voxel", "--leaf 1").code == 0);
  CHECK(place.result().size() == 4 + 1);
  const test::Outcome fine = place.run("voxel", "--leaf 0.001");
  CHECK(fine.code == 1);
  CHECK_THAT(fine.output, Catch::Contains("raise `leaf` or remove far outliers"));
  REQUIRE(place.run("sor", "--rule one-sided").code == 0);
  CHECK(place.result().size() == 1600 - 3);  // an outlier if ever there was one
  CHECK(place.run("carve", "").code == 0);
  const test::Outcome octree = place.run("octree", "");
  CHECK(octree.code == 1);
  CHECK_THAT(octree.output, Catch::Contains("1000000") && Catch::Contains("outside the tree"));
  const test::Outcome grid = place.run("project2d", "--ground '0 0 1 1' --max-height 1e3");
  CHECK(grid.code == 0);  // too high for the robot: not in the grid
  const test::Outcome wide = place.run("project2d", "--ground '0 1 0 1' --max-height 100 --resolution 0.01");
  CHECK(wide.code == 1);
  CHECK_THAT(wide.output, Catch::Contains("more than 2^28"));
}

TEST_CASE("k beyond the cloud means all the others, and sizes of 0 are wrong calls") {
  const Workplace place(LabelledCloud{at(0, 0, 2), at(0.1F, 0, 2), at(0, 0.1F, 2)});
  REQUIRE(place.run("sor", "--neighbors 50").code == 0);
  CHECK(place.result().size() == 3);
  CHECK(place.run("sor", "--neighbors 0").code == 2);
  CHECK(place.run("voxel", "--leaf 0").code == 2);
  CHECK(place.run("octree", "--resolution-m 0").code == 2);
  CHECK(place.run("project2d", "--resolution 0").code == 2);
}

TEST_CASE("fuse fails where there is no depth, and says so") {
  const test::TemporaryFolder folder;
  test::TinySequence sequence = test::tiny_sequence();
  for (Frame& frame : sequence.frames) frame.depth = cv::Scalar(0);
  const fs::path yaml = test::write_sequence(folder / "sequence", sequence);
  std::vector<FrameTracking> tracking;
  for (const StampedPose& pose : sequence.groundtruth)
    tracking.push_back({pose.stamp, TrackingState::tracked, true, 1, 1, 0});
  fs::create_directories(folder / "track");
  write_trajectory(folder / "track", sequence.groundtruth, tracking);
  const test::Outcome none = test::run_program("fuse", "--sequence '" + yaml.string() + "' --trajectory '" +
                                                           (folder / "track").string() + "' --out '" +
                                                           (folder / "out").string() + "'");
  CHECK(none.code == 1);
  CHECK_THAT(none.output, Catch::Contains("no depth"));
}

TEST_CASE("every stage of the map writes equal bytes with 1, 2 and 4 threads") {
  LabelledCloud cloud;
  for (unsigned i = 0; i < 20000; ++i)
    cloud.push_back(at(static_cast<float>(i * 7919 % 1000) / 500 - 1,
                       static_cast<float>(i * 104729 % 777) / 500,
                       2 + 0.003F * static_cast<float>(i * 31 % 7)));
  const Workplace place(cloud);
  for (const std::string stage : {"sor", "voxel", "carve", "octree", "project2d"}) {
    INFO(stage);
    const std::string more = stage == "project2d" ? "--ground '0 1 0 1' --empty-cells seen" : "";
    std::string ids[3];
    int i = 0;
    for (const char* threads : {"1", "2", "4"}) {
      REQUIRE(place.run(stage, more + " --threads " + threads).code == 0);
      ids[i++] = contract::read_manifest(place.folder / "out").id();
    }
    CHECK(ids[0] == ids[1]);
    CHECK(ids[0] == ids[2]);
  }
}
