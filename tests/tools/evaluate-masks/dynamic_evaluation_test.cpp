#include "tools/evaluate-masks/dynamic_evaluation.hpp"

#include <catch2/catch.hpp>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using namespace sediment::tools;
using Catch::Matchers::Contains;

namespace {

struct Box {
  cv::Rect place;
  int value;
};

cv::Mat with(int type, std::initializer_list<Box> boxes) {
  cv::Mat image(100, 100, type, cv::Scalar(0));
  for (const Box& box : boxes) image(box.place).setTo(box.value);
  return image;
}

/// Truth of two frames: a person of 20 x 50 pixels who pushes a chair of 20 x 20 in the second one.
struct Bench {
  Bench() {
    const Box person{{10, 10, 20, 50}, 1}, resting{{40, 40, 20, 20}, 0}, pushed{{40, 40, 20, 20}, 2};
    write_png(truth() / "1.5.png", with(CV_8UC1, {person, resting}));
    write_png(truth() / "2.5.png", with(CV_8UC1, {person, pushed}));
    const cv::Mat ids = with(CV_16UC1, {{{0, 90, 100, 10}, 9}, {person.place, 4}, {pushed.place, 7}});
    for (const char* stamp : {"1.5.png", "2.5.png"}) write_png(folder / "truth" / "instances" / stamp, ids);
    write_bytes(
        folder / "truth" / "instances.json",
        {R"({"instances": [{"id": 4, "class": "person"}, {"id": 7, "class": "chair"}, {"id": 9, "class": "floor"}]})"});
  }
  std::filesystem::path truth() const { return folder / "truth" / "dynamic"; }
  std::filesystem::path masks() const { return folder / "masks"; }
  DynamicEvaluation evaluate(bool with_instances = true) const {
    return evaluate_dynamic(MaskFolder(truth()), MaskFolder(masks()),
                            with_instances ? InstanceTruth::beside(truth()) : std::nullopt);
  }

  test::TemporaryFolder folder;
};

}  // namespace

TEST_CASE("hits, misses and lost pixels are counted by class and by kind of motion") {
  const Bench bench;
  // Half of the person in the first frame; person, a quarter of the chair and a strip of the floor in the
  // second.
  write_png(bench.masks() / "1.5.png", with(CV_8UC1, {{{10, 10, 10, 50}, 1}}));
  write_png(bench.masks() / "2.5.png",
            with(CV_8UC1, {{{10, 10, 20, 50}, 1}, {{40, 40, 10, 10}, 2}, {{0, 95, 100, 5}, 1}}));
  const DynamicEvaluation e = bench.evaluate();
  REQUIRE(e.frames.size() == 2);
  const Overlap total = e.total();
  CHECK(total.hit == 500 + 1000 + 100);
  CHECK(total.missed == 500 + 300);
  CHECK(total.extra == 500);
  CHECK(e.frames[0].prior == 1000);
  CHECK(e.frames[0].prior_hit == 500);
  CHECK(e.frames[1].non_prior == 400);
  CHECK(e.frames[1].non_prior_hit == 100);
  const auto classes = e.classes();
  CHECK(classes.at("person").dynamic == 2000);
  CHECK(classes.at("person").dynamic_masked == 1500);
  CHECK(classes.at("chair").dynamic == 400);
  CHECK(classes.at("chair").still == 400);
  CHECK(classes.at("chair").still_masked == 0);
  CHECK(classes.at("floor").still_masked == 500);
  CHECK(classes.at("floor").still == 2000);
}

TEST_CASE("a visible mover is missed below a recall of one half, each mover for itself") {
  const Bench bench;
  write_png(bench.masks() / "1.5.png", with(CV_8UC1, {{{10, 10, 10, 50}, 1}}));  // exactly one half
  write_png(bench.masks() / "2.5.png", with(CV_8UC1, {{{10, 10, 20, 50}, 1}, {{40, 40, 9, 20}, 1}}));
  const DynamicEvaluation e = bench.evaluate();
  CHECK(e.frames_with_mover() == 2);
  CHECK(e.frames[0].missed.empty());
  REQUIRE(e.frames[1].missed.size() == 1);
  CHECK(e.frames[1].missed[0].name == "chair 7");
  CHECK(e.frames[1].missed[0].share == 0.04);
  CHECK(e.frames[1].missed[0].recall == 0.45);
  CHECK(e.missed_frames() == 1);
  // Without instances the movers of a frame are judged together.
  CHECK(bench.evaluate(false).missed_frames() == 0);
}

TEST_CASE("a mover of one per cent of the image or less is not asked for") {
  const Bench bench;
  for (const char* stamp : {"1.5.png", "2.5.png"}) {
    write_png(bench.truth() / stamp, with(CV_8UC1, {{{10, 10, 10, 10}, 1}}));
    write_png(bench.masks() / stamp, with(CV_8UC1, {}));
  }
  CHECK(bench.evaluate().frames_with_mover() == 0);
  write_png(bench.truth() / "1.5.png", with(CV_8UC1, {{{10, 10, 10, 11}, 1}}));
  CHECK(bench.evaluate().frames_with_mover() == 1);
  CHECK(bench.evaluate().missed_frames() == 1);
}

TEST_CASE("frames without a mask are left out and counted, masks of instances count by their class") {
  const Bench bench;
  MasksWriter writer(bench.masks());
  writer.write("2.5", {with(CV_16UC1, {{{10, 10, 20, 50}, 3}, {{40, 40, 20, 20}, 5}}),
                       {{3, "person", 1, {}}, {5, "chair", 1, {}}}});
  writer.write("3.5", {with(CV_16UC1, {}), {}});
  writer.finish();
  const DynamicEvaluation e = bench.evaluate();
  CHECK(e.frames.size() == 1);
  CHECK(e.truth_frames == 2);
  CHECK(e.mask_frames == 2);
  CHECK(e.total().hit == 1000);
  CHECK(e.total().extra == 0);
  CHECK(e.total().missed == 400);
}

TEST_CASE("folders that cannot be compared are refused") {
  const Bench bench;
  write_png(bench.masks() / "9.5.png", with(CV_8UC1, {}));
  CHECK_THROWS_WITH(bench.evaluate(), Contains("no frame has both"));
  write_png(bench.masks() / "1.5.png", cv::Mat(50, 100, CV_8UC1, cv::Scalar(0)));
  CHECK_THROWS_WITH(bench.evaluate(),
                    Contains("frame 1.5: the truth has 100 x 100 pixels, the mask 100 x 50"));
  CHECK_THROWS_WITH(MaskFolder(bench.folder / "none"), Contains("there is no such folder"));
  CHECK_THROWS_WITH(MaskFolder(bench.folder / "truth"), Contains("holds no mask"));
  write_png(bench.folder / "odd" / "first.png", with(CV_8UC1, {}));
  CHECK_THROWS_WITH(MaskFolder(bench.folder / "odd"), Contains("first.png: the name of a mask is the stamp"));
}

TEST_CASE("true instances whose ids change their class are refused") {
  const test::TemporaryFolder folder;
  MasksWriter writer(folder.path());
  writer.write("1", {with(CV_16UC1, {}), {{1, "person", 1, {}}}});
  writer.write("2", {with(CV_16UC1, {}), {{1, "chair", 1, {}}}});
  writer.finish();
  CHECK_THROWS_WITH(InstanceTruth(folder.path()),
                    Contains("instances.json") && Contains("a person and a chair"));
}
