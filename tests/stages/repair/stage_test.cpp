#include <algorithm>
#include <catch2/catch.hpp>
#include <opencv2/core.hpp>

#include "pipeline/artifacts/masks.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/stages/repair/moving_card.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiny_sequence.hpp"

using namespace sediment;

namespace {

constexpr int kFrames = 40;

/// The moving card as a sequence on disk; the detections of frames 10 .. 17 are missing, frame 25 has another
/// class.
struct Scene {
  sediment::test::TemporaryFolder folder;
  std::vector<std::string> stamps;

  Scene() {
    repair::test::CardScene cards;
    cards.step_px = 2;
    auto sequence = sediment::test::tiny_sequence(kFrames);
    sequence.camera = {160, 120, 150, 150, 79.5, 59.5, {}, 5000};
    MasksWriter masks(folder / "masks");
    for (int i = 0; i < kFrames; ++i) {
      const auto idx = static_cast<std::size_t>(i);
      repair::ClipFrame card = cards.frame(idx);
      sequence.frames[idx].color = card.color;
      sequence.frames[idx].depth = card.depth;
      if (i >= 10 && i < 18) repair::test::forget_detections(card);
      if (i == 25) card.detections.instances[0].class_name = "dog";
      stamps.push_back(sequence.frames[idx].stamp);
      masks.write(stamps.back(), card.detections);
    }
    masks.finish();
    sediment::test::write_sequence(folder / "sequence", sequence);
  }

  sediment::test::Outcome run(const std::string& masks, const std::string& more) const {
    return sediment::test::run_program("repair", "--sequence '" + (folder / "sequence").string() +
                                                     "' --masks '" + (folder / masks).string() + "' " + more);
  }
  std::string out(const std::string& name) const { return "--out '" + (folder / name).string() + "' "; }
};

}  // namespace

TEST_CASE("the stage repair gives a card one id, one class, a mask in every frame and its speed") {
  const Scene scene;
  const auto done = scene.run("masks", scene.out("result"));
  INFO(done.output);
  REQUIRE(done.code == 0);
  const MasksReader masks(scene.folder / "result");
  for (int i = 0; i < kFrames; ++i) {
    INFO("frame " << i);
    const InstanceMask mask = masks.read(scene.stamps[static_cast<std::size_t>(i)]);
    REQUIRE(mask.instances.size() == 1);
    CHECK(mask.instances[0].id == 1);
    CHECK(mask.instances[0].class_name == "person");
    cv::Mat truth(120, 160, CV_8UC1, cv::Scalar(0));
    truth(cv::Rect(20 + 2 * i, 30, 40, 60)) = 255;
    CHECK(repair::test::overlap(mask.ids > 0, truth) > 0.93);
    if (i + 1 < kFrames) {
      REQUIRE(mask.instances[0].speed_m_s);
      // Two pixels at 1 m each 40 ms, less what the error of the camera's motion explains.
      const double truth_m_s = 2.0 / 150 / 0.04;
      CHECK(*mask.instances[0].speed_m_s < 1.05 * truth_m_s);
      CHECK(*mask.instances[0].speed_m_s > 0.75 * truth_m_s);
    }
  }
}

TEST_CASE("the stage repair writes equal bytes with 1 and with 4 threads") {
  const Scene scene;
  REQUIRE(scene.run("masks", scene.out("one") + "--threads 1").code == 0);
  REQUIRE(scene.run("masks", scene.out("four") + "--threads 4").code == 0);
  CHECK(contract::read_manifest(scene.folder / "one").id() ==
        contract::read_manifest(scene.folder / "four").id());
}

TEST_CASE("a thing is carried two frames on into such in which nothing at all is detected") {
  const Scene scene;
  const MasksReader detected(scene.folder / "masks");
  MasksWriter chairs(scene.folder / "chairs");
  for (std::size_t i = 0; i < scene.stamps.size(); ++i) {
    InstanceMask mask = detected.read(scene.stamps[i]);
    for (Instance& instance : mask.instances) instance.class_name = "chair";
    if (i < 20 || i > 30) mask = {cv::Mat(120, 160, CV_16UC1, cv::Scalar(0)), {}};
    if (i == 19) {  // something else is detected here, so the chair is not there
      mask.ids(cv::Rect(0, 0, 15, 15)) = 2;
      mask.instances = {{2, "book", 0.9}};
    }
    chairs.write(scene.stamps[i], mask);
  }
  chairs.finish();
  REQUIRE(scene.run("chairs", scene.out("result")).code == 0);
  const MasksReader result(scene.folder / "result");
  const auto has_chair = [&](std::size_t i) {
    const auto instances = result.instances(scene.stamps[i]);
    return std::any_of(instances.begin(), instances.end(),
                       [](const Instance& instance) { return instance.class_name == "chair"; });
  };
  CHECK_FALSE(has_chair(19));
  CHECK((has_chair(18) && has_chair(20) && has_chair(30) && has_chair(31) && has_chair(32)));
  CHECK_FALSE((has_chair(17) || has_chair(33)));
}

TEST_CASE("the stage repair takes masks without any instance") {
  const Scene scene;
  MasksWriter none(scene.folder / "none");
  for (const std::string& stamp : scene.stamps)
    none.write(stamp, {cv::Mat(120, 160, CV_16UC1, cv::Scalar(0)), {}});
  none.finish();
  REQUIRE(scene.run("none", scene.out("result")).code == 0);
  CHECK(MasksReader(scene.folder / "result").instances(scene.stamps[7]).empty());
}

TEST_CASE("the stage repair names the frame whose mask has another size") {
  const Scene scene;
  MasksWriter large(scene.folder / "large");
  for (const std::string& stamp : scene.stamps)
    large.write(stamp, {cv::Mat(24, 32, CV_16UC1, cv::Scalar(0)), {}});
  large.finish();
  const auto refused = scene.run("large", scene.out("result"));
  CHECK(refused.code == 1);
  CHECK_THAT(refused.output,
             Catch::Contains("the mask is 32x24, the image 160x120") && Catch::Contains("frame 10"));
}
