#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "stages/segment/mask_source.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/tiny_sequence.hpp"

using namespace sediment;
using namespace sediment::segment;
using Catch::Matchers::Contains;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr int kGivenFrames = 3;
const cv::Rect kPerson(10, 20, 8, 12);

/// Three frames of 64 x 48 pixels, and a folder for masks.
struct Given {
  test::TemporaryFolder folder;
  fs::path masks = folder / "given";
  Sequence sequence;

  Given() {
    test::write_sequence(folder / "sequence", test::tiny_sequence(kGivenFrames));
    sequence = Sequence::open(folder / "sequence/sequence.yaml");
    fs::create_directories(masks);
  }

  const std::string& stamp(std::size_t frame_idx) const { return sequence.entry(frame_idx).stamp; }
  std::unique_ptr<MaskSource> open(Parameters parameters = {}) const {
    parameters.engine = Engine::given;
    return open_source(parameters, sequence, std::nullopt, masks);
  }
  void write_binary(std::size_t frame_idx, int value = 255, cv::Size size = {64, 48}) const {
    cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
    mask(kPerson) = value;
    write_png(masks / (stamp(frame_idx) + ".png"), mask);
  }
  void write_artifact(const std::string& class_name) const {
    MasksWriter writer(masks);
    for (std::size_t i = 0; i < kGivenFrames; ++i) {
      InstanceMask mask{cv::Mat::zeros(48, 64, CV_16UC1),
                        {{3, class_name, 0.7, {10, 20, 18, 32}}, {8, "chair", 0.6, {}}}};
      mask.ids(kPerson) = 3;
      mask.ids(cv::Rect(30, 30, 5, 5)) = 8;
      writer.write(stamp(i), mask);
    }
    writer.finish();
  }
  Json coco() const {
    Json json = {{"images", Json::array()},
                 {"categories", {{{"id", 1}, {"name", "person"}}, {{"id", 62}, {"name", "chair"}}}},
                 {"annotations", Json::array()}};
    for (int i = 0; i < kGivenFrames; ++i)
      json["images"].push_back({{"id", i},
                                {"file_name", stamp(static_cast<std::size_t>(i)) + ".png"},
                                {"width", 64},
                                {"height", 48}});
    json["annotations"].push_back({{"id", 1},
                                   {"image_id", 1},
                                   {"category_id", 62},
                                   {"score", 0.4},
                                   {"segmentation", {{8, 20, 22, 20, 22, 32, 8, 32}}}});
    json["annotations"].push_back({{"id", 2},
                                   {"image_id", 1},
                                   {"category_id", 1},
                                   {"score", 0.9},
                                   {"segmentation", {{10, 20, 18, 20, 18, 32, 10, 32}}}});
    return json;
  }
  void write_json(const Json& json, const std::string& name = "annotations.json") const {
    std::ofstream(masks / name) << json.dump();
  }
};

}  // namespace

TEST_CASE("binary images give one person per frame, or none") {
  const Given given;
  given.write_binary(0);
  given.write_binary(1);
  write_png(given.masks / (given.stamp(2) + ".png"), cv::Mat::zeros(48, 64, CV_8UC1));
  const auto source = given.open();
  CHECK(source->missing() == 0);
  const InstanceMask mask = source->masks_of(1);
  REQUIRE(mask.instances.size() == 1);
  CHECK(mask.instances[0].class_name == "person");
  CHECK(mask.instances[0].box_px == std::array<double, 4>{10, 20, 18, 32});
  CHECK(cv::countNonZero(mask.ids == 1) == kPerson.area());
  CHECK(cv::countNonZero(mask.ids(kPerson)) == kPerson.area());
  CHECK(source->masks_of(2).instances.empty());
  Parameters cats;
  cats.given_class = "cat";
  CHECK(given.open(cats)->masks_of(1).instances[0].class_name == "cat");
}

TEST_CASE("binary images may lie in a subfolder masks and be named as the colour image") {
  const Given given;
  fs::create_directories(given.masks / "masks");
  for (std::size_t i = 0; i < kGivenFrames; ++i) {
    given.write_binary(i);
    fs::rename(given.masks / (given.stamp(i) + ".png"),
               given.masks / "masks" / (given.sequence.entry(i).color.stem().string() + ".png"));
  }
  CHECK(given.open()->masks_of(2).instances.size() == 1);
}

TEST_CASE("binary images of other values, depths and sizes are refused by name") {
  const Given given;
  given.write_binary(0, 1);
  given.write_binary(1, 255, {60, 48});
  write_png(given.masks / (given.stamp(2) + ".png"), cv::Mat::zeros(48, 64, CV_16UC1));
  const auto source = given.open();
  CHECK_THROWS_WITH(source->masks_of(0),
                    Contains(given.stamp(0) + ".png: expected pixels of 0 and 255, found 1"));
  CHECK_THROWS_WITH(source->masks_of(1), Contains(given.stamp(1) + ".png: expected masks of 64 x 48") &&
                                             Contains("found 60 x 48"));
  CHECK_THROWS_WITH(source->masks_of(2), Contains(given.stamp(2) + ".png: expected 8 bits"));
}

TEST_CASE("a frame without a mask is an error unless it may be empty") {
  const Given given;
  given.write_binary(0);
  given.write_binary(2);
  CHECK_THROWS_WITH(given.open(), Contains("1 of 3 frames have no mask, the first is " + given.stamp(1)));
  Parameters lenient;
  lenient.missing = Missing::empty;
  const auto source = given.open(lenient);
  CHECK(source->missing() == 1);
  CHECK(source->masks_of(1).instances.empty());
  CHECK(source->masks_of(1).ids.size() == cv::Size(64, 48));
  CHECK(source->masks_of(2).instances.size() == 1);
}

TEST_CASE("masks of another sequence are refused even if frames may be missing") {
  const Given given;
  given.write_binary(0);
  fs::rename(given.masks / (given.stamp(0) + ".png"), given.masks / "7.000000.png");
  Parameters lenient;
  lenient.missing = Missing::empty;
  CHECK_THROWS_WITH(given.open(lenient), Contains("no frame of the sequence has a mask"));
}

TEST_CASE("a folder without masks and one with several lists are refused") {
  const Given given;
  CHECK_THROWS_WITH(given.open(), Contains("there are no masks"));
  given.write_json(given.coco());
  given.write_json(given.coco(), "more.json");
  CHECK_THROWS_WITH(given.open(), Contains("has 2 JSON files"));
}

TEST_CASE("the masks artifact is taken with its ids, and classes can be picked") {
  const Given given;
  given.write_artifact("person");
  const InstanceMask all = given.open()->masks_of(1);
  REQUIRE(all.instances.size() == 2);
  CHECK(all.instances[0].id == 3);
  CHECK(all.instances[0].score == 0.7);
  Parameters chairs;
  chairs.classes = {"chair"};
  const InstanceMask picked = given.open(chairs)->masks_of(1);
  REQUIRE(picked.instances.size() == 1);
  CHECK(picked.instances[0].id == 8);
  CHECK(cv::countNonZero(picked.ids) == 25);
}

TEST_CASE("a class that the label table does not know is refused unless it may be kept") {
  const Given given;
  given.write_artifact("persn");
  CHECK_THROWS_WITH(given.open()->masks_of(0),
                    Contains("frame " + given.stamp(0) +
                             ": instance 3 is of the unknown class \"persn\", is it \"person\"?"));
  Parameters lenient;
  lenient.unknown_classes = Unknown::keep;
  CHECK(given.open(lenient)->masks_of(0).instances[0].class_name == "persn");
}

TEST_CASE("a COCO file is read by name or from its folder, better scores in front") {
  const Given given;
  given.write_json(given.coco());
  const auto check = [](const MaskSource& source) {
    CHECK(source.masks_of(0).instances.empty());
    const InstanceMask mask = source.masks_of(1);
    REQUIRE(mask.instances.size() == 2);
    CHECK(mask.instances[0].class_name == "person");
    CHECK(mask.instances[0].score == 0.9);
    CHECK(cv::countNonZero(mask.ids == 1) == kPerson.area());
    CHECK(cv::countNonZero(mask.ids == 2) == 14 * 12 - kPerson.area());
  };
  check(*given.open());
  Parameters parameters;
  check(*open_source(parameters, given.sequence, std::nullopt, given.masks / "annotations.json"));
}

TEST_CASE("a COCO file of other frames, sizes and classes is refused") {
  const Given given;
  Json json = given.coco();
  json["images"][2]["file_name"] = "other.png";
  json["images"][1]["width"] = 60;
  json["categories"][1]["name"] = "thing";
  given.write_json(json);
  CHECK_THROWS_WITH(given.open(), Contains("1 of 3 frames have no mask"));
  Parameters lenient;
  lenient.missing = Missing::empty;
  CHECK_THROWS_WITH(given.open(lenient)->masks_of(1),
                    Contains("annotations.json: expected masks of 64 x 48"));
  json["images"][1]["width"] = 64;
  given.write_json(json);
  CHECK_THROWS_WITH(given.open(lenient)->masks_of(1), Contains("unknown class \"thing\""));
}
