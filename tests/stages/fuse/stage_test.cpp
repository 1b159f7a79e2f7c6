#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/manifest.hpp"
#include "pipeline/contract/stage.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiny_sequence.hpp"

using namespace sediment;
namespace fs = std::filesystem;

namespace {

constexpr int kFrames = 9;

/// The tiny wall with its true poses; frames 0, 4 and 8 are keyframes. Columns 0..9 of the dynamic masks are
/// dynamic, columns 30..39 of the masks are a chair.
struct Scene {
  test::TemporaryFolder folder;
  test::TinySequence sequence = test::tiny_sequence(kFrames);

  Scene() {
    test::write_sequence(folder / "sequence", sequence);
    std::vector<FrameTracking> tracking;
    MasksWriter masks(folder / "masks");
    DynamicMasksWriter dynamic(folder / "dynamic");
    for (int i = 0; i < kFrames; ++i) {
      const std::string& stamp = sequence.frames[static_cast<std::size_t>(i)].stamp;
      tracking.push_back({stamp, TrackingState::tracked, i % 4 == 0});
      InstanceMask mask{cv::Mat(48, 64, CV_16UC1, cv::Scalar(0)), {{3, "chair"}}};
      mask.ids.colRange(30, 40) = 3;
      masks.write(stamp, mask);
      cv::Mat moving(48, 64, CV_8UC1, cv::Scalar(kStatic));
      moving.colRange(0, 10) = kPriorDynamic;
      dynamic.write(stamp, moving, {});
    }
    masks.finish();
    dynamic.finish();
    fs::create_directories(folder / "track");
    write_trajectory(folder / "track", sequence.groundtruth, tracking);
  }

  std::string path(const std::string& name) const { return "'" + (folder / name).string() + "' "; }
  test::Outcome run(const std::string& more, const std::string& track = "track") const {
    return test::run_program("fuse", "--sequence " + path("sequence/sequence.yaml") + "--trajectory " +
                                         path(track) + "--masks " + path("masks") + "--dynamic " +
                                         path("dynamic") + more);
  }
};

}  // namespace

TEST_CASE("the stage fuse puts the wall of every keyframe onto one plane, labelled, without what moves") {
  const Scene scene;
  const test::Outcome done = scene.run("--pixel-step 1 --out " + scene.path("result"));
  INFO(done.output);
  REQUIRE(done.code == 0);
  const LabelledCloud cloud = read_cloud(scene.folder / "result");
  CHECK(cloud.size() == 3 * 54 * 47);  // three keyframes; ten columns move, the top row has no depth
  std::size_t chair = 0;
  for (const LabelledPoint& point : cloud) {
    REQUIRE(point.z == Approx(2).margin(1e-5));
    chair += point.label == 56 && point.instance == 3;
  }
  CHECK(chair == 3 * 10 * 47);
  const auto metrics = contract::Json::parse(std::ifstream(scene.folder / "result/metrics.json"));
  CHECK(metrics["frames_fused"] == 3);
  CHECK(metrics["pixels_dynamic"] == 3 * 10 * 48);
  CHECK(metrics["pixels_out_of_range"] == 3 * 54);
  CHECK(read_cloud_labels(scene.folder / "result").find(56U) != nullptr);
}

TEST_CASE("the stage fuse writes equal bytes with 1 and with 4 threads in every encoding") {
  const Scene scene;
  const std::string encoding = GENERATE("binary", "ascii", "binary_compressed");
  const std::string flags = "--frames all --encoding " + encoding;
  REQUIRE(scene.run(flags + " --threads 1 --out " + scene.path("one")).code == 0);
  REQUIRE(scene.run(flags + " --threads 4 --out " + scene.path("four")).code == 0);
  CHECK(contract::read_manifest(scene.folder / "one").id() ==
        contract::read_manifest(scene.folder / "four").id());
  CHECK(read_cloud(scene.folder / "one").size() == kFrames * 27 * 23);
}

TEST_CASE("frames that are no keyframes fill only what no keyframe saw, the same at any thread count") {
  const Scene scene;
  REQUIRE(scene.run("--out " + scene.path("plain")).code == 0);
  REQUIRE(scene.run("--fill-m 0.01 --fill-step 2 --threads 1 --out " + scene.path("one")).code == 0);
  REQUIRE(scene.run("--fill-m 0.01 --fill-step 2 --threads 4 --out " + scene.path("four")).code == 0);
  CHECK(contract::read_manifest(scene.folder / "one").id() ==
        contract::read_manifest(scene.folder / "four").id());
  const LabelledCloud plain = read_cloud(scene.folder / "plain"), filled = read_cloud(scene.folder / "one");
  REQUIRE(filled.size() > plain.size());
  CHECK(std::equal(plain.begin(), plain.end(), filled.begin()));
  const auto metrics = contract::Json::parse(std::ifstream(scene.folder / "one/metrics.json"));
  CHECK(metrics["frames_filling"] == kFrames - 3);
  CHECK(metrics["points_filling"] == filled.size() - plain.size());
  // Pixels of the wall are 6.7 cm apart: where a keyframe has a point within a centimetre, no other frame
  // adds one.
  for (std::size_t i = plain.size(); i < filled.size(); ++i)
    for (const LabelledPoint& p : plain) REQUIRE(std::hypot(p.x - filled[i].x, p.y - filled[i].y) > 0.01);
}

TEST_CASE("frames that fill are asked for every pixel unless told otherwise") {
  const Scene scene;
  const auto visited = [&](const std::string& flags, const std::string& out) {
    REQUIRE(scene.run("--fill-m 0.01 " + flags + " --out " + scene.path(out)).code == 0);
    return contract::Json::parse(std::ifstream(scene.folder / (out + "/metrics.json")))["pixels_visited"]
        .get<int>();
  };
  CHECK(visited("--fill-step 2", "coarse") == kFrames * 32 * 24);
  CHECK(visited("", "fine") == 3 * 32 * 24 + (kFrames - 3) * 64 * 48);
}

TEST_CASE("the stage fuse runs without masks: everything is static and unlabelled") {
  const Scene scene;
  REQUIRE(test::run_program("fuse", "--sequence " + scene.path("sequence") + "--trajectory " +
                                        scene.path("track") + "--pixel-step 1 --out " + scene.path("result"))
              .code == 0);
  const LabelledCloud cloud = read_cloud(scene.folder / "result");
  CHECK(cloud.size() == 3 * 64 * 47);
  for (const LabelledPoint& point : cloud) REQUIRE((point.label == kUnlabelled && point.instance == 0));
}

TEST_CASE("the stage fuse counts frames without a pose and fails when no point is left, saying why") {
  const Scene scene;
  fs::create_directories(scene.folder / "lost");
  const Trajectory half(scene.sequence.groundtruth.begin(), scene.sequence.groundtruth.begin() + 5);
  write_trajectory(scene.folder / "lost", half, {});
  REQUIRE(scene.run("--frames all --out " + scene.path("result"), "lost").code == 0);
  const auto metrics = contract::Json::parse(std::ifstream(scene.folder / "result/metrics.json"));
  CHECK(metrics["frames_fused"] == 5);
  CHECK(metrics["frames_without_pose"].size() == 4);
  CHECK(metrics["frames_without_pose"][0] == scene.sequence.frames[5].stamp);

  const test::Outcome none = scene.run("--max-depth-m 1 --out " + scene.path("nothing"));
  CHECK(none.code == 1);
  CHECK_THAT(none.output,
             Catch::Contains("no point for the map") && Catch::Contains("have no depth in the range"));
  CHECK_FALSE(fs::exists(scene.folder / "nothing"));
}
