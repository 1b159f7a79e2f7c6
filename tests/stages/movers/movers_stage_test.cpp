#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "pipeline/contract/manifest.hpp"
#include "pipeline/scene/frame.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/synthetic/synthetic_sequence.hpp"

using namespace sediment;
using namespace sediment::test;

namespace {

constexpr int kWidth = 240, kHeight = 180;

/// A synthetic scene on disk, with its true poses and dynamic masks in which nothing moves.
struct Scene {
  TemporaryFolder folder;
  SyntheticSequence truth;

  explicit Scene(const std::string& name, int frames = 40) {
    const SyntheticSettings settings{
        .scene = name, .frames = frames, .width = kWidth, .height = kHeight, .rate_hz = 10};
    truth = synthetic_sequence(settings);
    write_synthetic_sequence(folder / "sequence", settings);
    DynamicMasksWriter none(folder / "none");
    std::vector<FrameTracking> tracking;
    for (const Frame& frame : truth.frames) {
      none.write(frame.stamp, cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(kStatic)), {});
      tracking.push_back({frame.stamp, TrackingState::tracked, true, 1, 1, 0});
    }
    none.finish();
    std::filesystem::create_directories(folder / "track");
    write_trajectory(folder / "track", truth.groundtruth, tracking);
  }

  Outcome run(const std::string& out, const std::string& masks, const std::string& more = "") const {
    return run_program("movers", "--sequence '" + (folder / "sequence/sequence.yaml").string() +
                                     "' --dynamic '" + (folder / masks).string() + "' --trajectory '" +
                                     (folder / "track").string() + "' --out '" + (folder / out).string() +
                                     "' " + more);
  }
  cv::Mat mask(const std::string& out, std::size_t frame_idx) const {
    return DynamicMasksReader(folder / out).read(truth.frames[frame_idx].stamp);
  }
};

}  // namespace

TEST_CASE("people and things that nothing names are found, and hardly anything else") {
  const Scene scene(GENERATE("walking", "carried-box"));
  const Outcome done = scene.run("out", "none");
  INFO(done.output);
  REQUIRE(done.code == 0);
  int found = 0, missed = 0, wrong = 0;
  for (std::size_t i = 0; i < scene.truth.frames.size(); ++i) {
    const cv::Mat mask = scene.mask("out", i) != kStatic, truth = scene.truth.dynamic[i] != kStatic;
    found += cv::countNonZero(mask & truth);
    missed += cv::countNonZero(~mask & truth);
    wrong += cv::countNonZero(mask & ~truth);
  }
  CHECK(found > 0.5 * (found + missed));
  CHECK(found > 0.95 * (found + wrong));
}

TEST_CASE("what moves later is not marked where it rests at the start of a sequence") {
  const Scene scene("walking");  // the chair is pushed from frame 10 on
  REQUIRE(scene.run("out", "none").code == 0);
  int marked = 0, people = 0;
  for (std::size_t i = 3; i < 9; ++i) {
    const cv::Mat found = scene.mask("out", i) != kStatic, moves = scene.truth.dynamic[i] != kStatic;
    marked += cv::countNonZero(found & ~moves);
    people += cv::countNonZero(found & moves);
  }
  INFO(marked << " " << people);
  CHECK(marked < 0.05 * people);
}

TEST_CASE("where nothing moves nothing is marked") {
  const Scene scene("static");
  REQUIRE(scene.run("out", "none").code == 0);
  std::ifstream stream(scene.folder / "out/metrics.json");
  const auto metrics = nlohmann::json::parse(stream);
  CHECK(metrics.at("pixels_added") == 0);
  CHECK(metrics.at("frames") == 40);
}

TEST_CASE("what is masked already stays as it is, and equal bytes come with 1 and with 4 threads") {
  const Scene scene("walking", 30);
  DynamicMasksWriter known(scene.folder / "known");
  for (std::size_t i = 0; i < scene.truth.frames.size(); ++i)
    known.write(scene.truth.frames[i].stamp, scene.truth.dynamic[i], {});
  known.finish();
  REQUIRE(scene.run("one", "known", "--threads 1").code == 0);
  REQUIRE(scene.run("four", "known", "--threads 4").code == 0);
  CHECK(contract::read_manifest(scene.folder / "one").id() ==
        contract::read_manifest(scene.folder / "four").id());
  for (std::size_t i = 0; i < scene.truth.frames.size(); ++i) {
    const cv::Mat before = scene.truth.dynamic[i], after = scene.mask("one", i);
    CHECK(cv::countNonZero((before != after) & (before != kStatic)) == 0);
  }
}

TEST_CASE("masks of frames without pose pass through, and no pose at all is an error") {
  const Scene scene("walking", 8);
  Trajectory half(scene.truth.groundtruth.begin(), scene.truth.groundtruth.begin() + 4);
  std::vector<FrameTracking> tracking;
  for (const auto& pose : half) tracking.push_back({pose.stamp, TrackingState::tracked, true, 1, 1, 0});
  write_trajectory(scene.folder / "track", half, tracking);
  REQUIRE(scene.run("out", "none").code == 0);
  for (std::size_t i = 4; i < 8; ++i) CHECK(cv::countNonZero(scene.mask("out", i)) == 0);
  write_trajectory(scene.folder / "track", {{"99.5", 99.5, {}}},
                   {{"99.5", TrackingState::tracked, true, 1, 1, 0}});
  const Outcome failed = scene.run("other", "none");
  CHECK(failed.code == 1);
  CHECK_THAT(failed.output, Catch::Contains("no frame of the sequence has a pose"));
}

TEST_CASE("a mask of another size is an error that names the frame") {
  const Scene scene("static", 4);
  DynamicMasksWriter small(scene.folder / "small");
  for (const Frame& frame : scene.truth.frames)
    small.write(frame.stamp, cv::Mat(24, 32, CV_8UC1, cv::Scalar(0)), {});
  small.finish();
  const Outcome failed = scene.run("out", "small");
  CHECK(failed.code == 1);
  CHECK_THAT(failed.output, Catch::Contains("dynamic mask of frame 1") && Catch::Contains("32 x 24 pixels"));
}

TEST_CASE("what was decided of interactions is handed on") {
  const Scene scene("static", 4);
  DynamicMasksWriter decided(scene.folder / "decided");
  for (const Frame& frame : scene.truth.frames)
    decided.write(frame.stamp, cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(kStatic)),
                  {{3, 7, "person", "cup", 40, 0.02, true}});
  decided.finish();
  REQUIRE(scene.run("out", "decided").code == 0);
  const auto handed_on = DynamicMasksReader(scene.folder / "out").interactions();
  REQUIRE(handed_on.size() == scene.truth.frames.size());
  for (const auto& [stamp, pairs] : handed_on) {
    REQUIRE(pairs.size() == 1);
    CHECK((pairs[0].dynamic_id == 3 && pairs[0].static_class == "cup" && pairs[0].interacting));
  }
}
