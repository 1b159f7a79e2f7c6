#include <catch2/catch.hpp>
#include <fstream>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "pipeline/contract/manifest.hpp"
#include "pipeline/contract/stage.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/same_image.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiny_sequence.hpp"

using namespace sediment;
namespace fs = std::filesystem;

namespace {

constexpr int kFrames = 6;

/// A person beside a chair, both at the wall's depth, in every frame. The chair is named last.
struct Scene {
  test::TemporaryFolder folder;
  test::TinySequence sequence = test::tiny_sequence(kFrames);

  Scene() {
    test::write_sequence(folder / "sequence", sequence);
    write_masks("masks", kFrames, cv::Size(64, 48));
  }

  void write_masks(const std::string& name, int frames, cv::Size size) const {
    MasksWriter writer(folder / name);
    for (int i = 0; i < frames; ++i) {
      InstanceMask mask{cv::Mat(size, CV_16UC1, cv::Scalar(0)), {{1, "person"}, {4, "chair"}}};
      mask.ids(cv::Rect(10 + i, 10, 8, 20)) = 1;
      mask.ids(cv::Rect(20 + i, 10, 8, 20)) = 4;
      writer.write(sequence.frames[static_cast<std::size_t>(i)].stamp, mask);
    }
    writer.finish();
  }

  test::Outcome run(const std::string& more, const std::string& masks = "masks") const {
    return test::run_program("interaction-mask", "--sequence '" +
                                                     (folder / "sequence/sequence.yaml").string() +
                                                     "' --masks '" + (folder / masks).string() + "' " + more);
  }
  std::string out(const std::string& name) const { return "--out '" + (folder / name).string() + "' "; }
};

}  // namespace

TEST_CASE("the stage interaction-mask masks the person and the chair beside, and lists the pair") {
  const Scene scene;
  const test::Outcome done = scene.run(scene.out("result"));
  REQUIRE(done.code == 0);
  const cv::Mat mask = DynamicMasksReader(scene.folder / "result").read(scene.sequence.frames[2].stamp);
  CHECK(mask.at<std::uint8_t>(15, 14) == kPriorDynamic);
  CHECK(mask.at<std::uint8_t>(15, 24) == kNonPriorDynamic);
  CHECK(cv::countNonZero(mask) == 2 * 8 * 20);
  const auto json = contract::Json::parse(std::ifstream(scene.folder / "result/interactions.json"));
  const auto& pair = json["frames"][2]["interactions"].at(0);
  CHECK(pair["interacting"] == true);
  CHECK(pair["static_class"] == "chair");
  CHECK(pair["mean_depth_difference_m"] == 0);
  const auto metrics = contract::Json::parse(std::ifstream(scene.folder / "result/metrics.json"));
  CHECK(metrics["pairs_interacting"] == kFrames);
  CHECK(metrics["dynamic_pixels"] == kFrames * 320);
}

TEST_CASE(
    "the stage interaction-mask goes by touch and says so where motion is asked for and no speed known") {
  const Scene scene;
  const test::Outcome by_motion = scene.run(scene.out("motion") + "--motion true"),
                      by_touch = scene.run(scene.out("touch"));
  REQUIRE(by_motion.code == 0);
  REQUIRE(by_touch.code == 0);
  CHECK_THAT(by_motion.output, Catch::Matchers::Contains("no object has a speed"));
  const std::string& stamp = scene.sequence.frames[2].stamp;
  CHECK(test::same_image(DynamicMasksReader(scene.folder / "motion").read(stamp),
                         DynamicMasksReader(scene.folder / "touch").read(stamp)));
}

TEST_CASE("the stage interaction-mask writes equal bytes with 1 and with 4 threads") {
  const Scene scene;
  REQUIRE(scene.run(scene.out("one") + "--threads 1 --preview true").code == 0);
  REQUIRE(scene.run(scene.out("four") + "--threads 4 --preview true").code == 0);
  const contract::Manifest one = contract::read_manifest(scene.folder / "one");
  CHECK(one.id() == contract::read_manifest(scene.folder / "four").id());
  CHECK(one.files.size() == 2 * kFrames + 2);  // masks, previews, interactions.json, metrics.json
}

TEST_CASE("the stage interaction-mask takes its classes from a label table that is given") {
  const Scene scene;
  std::ofstream(scene.folder / "labels.yaml") << "- {id: 1, name: chair, color: [1, 2, 3], dynamic: true}\n";
  REQUIRE(
      scene.run(scene.out("result") + "--labels '" + (scene.folder / "labels.yaml").string() + "'").code ==
      0);
  const cv::Mat mask = DynamicMasksReader(scene.folder / "result").read(scene.sequence.frames[0].stamp);
  CHECK(mask.at<std::uint8_t>(15, 22) == kPriorDynamic);
  CHECK(mask.at<std::uint8_t>(15, 12) == kNonPriorDynamic);
  const auto metrics = contract::Json::parse(std::ifstream(scene.folder / "result/metrics.json"));
  CHECK(metrics["instances_of_unlisted_classes"]["person"] == kFrames);
}

TEST_CASE("the stage interaction-mask names the frame that has no masks, and masks of another size") {
  const Scene scene;
  scene.write_masks("short", kFrames - 1, cv::Size(64, 48));
  const test::Outcome missing = scene.run(scene.out("result"), "short");
  CHECK(missing.code == 1);
  CHECK_THAT(missing.output, Catch::Contains(scene.sequence.frames[kFrames - 1].stamp));

  scene.write_masks("large", kFrames, cv::Size(128, 96));
  const test::Outcome large = scene.run(scene.out("result"), "large");
  CHECK(large.code == 1);
  CHECK_THAT(large.output,
             Catch::Contains("the mask is 128x96, the depth image 64x48") && Catch::Contains("frame 10"));
  CHECK_FALSE(fs::exists(scene.folder / "result"));
}

TEST_CASE("the stage interaction-mask refuses wrong calls") {
  const Scene scene;
  CHECK(scene.run("").code == 2);
  CHECK(scene.run(scene.out("result") + "--radius-px -1").code == 2);
  CHECK_THAT(scene.run(scene.out("result") + "--treshold-m 1").output, Catch::Contains("--threshold"));
}
