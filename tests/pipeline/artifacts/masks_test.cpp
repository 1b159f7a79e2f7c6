#include "pipeline/artifacts/masks.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

InstanceMask two_instances() {
  InstanceMask mask{cv::Mat(4, 6, CV_16UC1, cv::Scalar(0)), {}};
  mask.ids.at<std::uint16_t>(1, 2) = 3;
  mask.ids.at<std::uint16_t>(3, 5) = 700;
  mask.instances = {{3, "person", 0.9, {1, 2, 3.5, 4}}, {700, "dining table", 0.25, {0, 0, 6, 4}}};
  return mask;
}

void write_one(const std::filesystem::path& folder, const InstanceMask& mask) {
  MasksWriter writer(folder);
  writer.write("12.5", mask);
  writer.write("3.25", {cv::Mat(4, 6, CV_16UC1, cv::Scalar(0)), {}});
  writer.finish();
}

}  // namespace

TEST_CASE("masks survive writing and reading") {
  const test::TemporaryFolder folder;
  const InstanceMask mask = two_instances();
  write_one(folder.path(), mask);
  const MasksReader reader(folder.path());
  CHECK(reader.size() == 2);
  CHECK(reader.has("3.25"));
  CHECK_FALSE(reader.has("12.50"));
  const InstanceMask read = reader.read("12.5");
  CHECK(cv::norm(read.ids, mask.ids, cv::NORM_INF) == 0);
  REQUIRE(read.instances.size() == 2);
  CHECK(read.instances[1].id == 700);
  CHECK(read.instances[1].class_name == "dining table");
  CHECK(read.instances[0].score == 0.9);
  CHECK(read.instances[0].box_px == mask.instances[0].box_px);
  CHECK(reader.read("3.25").instances.empty());
}

TEST_CASE("the order in which frames are written leaves no trace") {
  const test::TemporaryFolder folder;
  write_one(folder / "a", two_instances());
  MasksWriter writer(folder / "b");
  writer.write("3.25", {cv::Mat(4, 6, CV_16UC1, cv::Scalar(0)), {}});
  writer.write("12.5", two_instances());
  writer.finish();
  CHECK(read_bytes(folder / "a" / "instances.json") == read_bytes(folder / "b" / "instances.json"));
}

TEST_CASE("damaged masks are refused with file and frame") {
  const test::TemporaryFolder folder;
  write_one(folder.path(), two_instances());
  const auto json = folder / "instances.json", image = folder / "masks" / "12.5.png";
  const auto replace = [&](const std::string& what, const std::string& by) {
    std::string text = read_bytes(json);
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    write_bytes(json, {text.replace(at, what.size(), by)});
  };
  const auto read = [&] { return MasksReader(folder.path()).read("12.5"); };
  SECTION("no json") {
    std::filesystem::remove(json);
    CHECK_THROWS_WITH(read(), Contains(json.string()));
  }
  SECTION("another version") {
    replace("sediment-masks 1", "sediment-masks 2");
    CHECK_THROWS_WITH(read(),
                      Contains(json.string()) &&
                          Contains("expected format \"sediment-masks 1\", found \"sediment-masks 2\""));
  }
  SECTION("json that is cut off") {
    write_bytes(json, {read_bytes(json).substr(0, 60)});
    CHECK_THROWS_WITH(read(), Contains(json.string()));
  }
  SECTION("an instance without a class") {
    replace("\"class\":\"person\",", "");
    CHECK_THROWS_WITH(read(), Contains(json.string()) && Contains("frame \"12.5\"") && Contains("class"));
  }
  SECTION("an id twice") {
    replace("\"id\":700", "\"id\":3");
    CHECK_THROWS_WITH(read(), Contains("frame \"12.5\": instance ids must be 1 .. 65535, ascending"));
  }
  SECTION("a pixel of no instance") {
    replace("\"id\":700", "\"id\":701");
    CHECK_THROWS_WITH(read(), Contains(image.string()) && Contains("pixel (5, 3) has id 700"));
  }
  SECTION("no image") {
    std::filesystem::remove(image);
    CHECK_THROWS_WITH(read(), Contains(image.string()));
  }
  SECTION("an image of 8 bits") {
    write_png(image, cv::Mat(4, 6, CV_8UC1, cv::Scalar(0)));
    CHECK_THROWS_WITH(read(), Contains(image.string()) && Contains("expected 16 bits"));
  }
  SECTION("a frame that is not there") {
    CHECK_THROWS_WITH(MasksReader(folder.path()).read("99"), Contains("there is no frame 99"));
  }
}

TEST_CASE("a frame can be written once only") {
  const test::TemporaryFolder folder;
  MasksWriter writer(folder.path());
  writer.write("1", two_instances());
  CHECK_THROWS_WITH(writer.write("1", two_instances()), Contains("frame 1"));
}

TEST_CASE("dynamic masks survive writing and reading, with or without their json and their folder") {
  const test::TemporaryFolder folder;
  cv::Mat mask(4, 6, CV_8UC1, cv::Scalar(0));
  mask.at<std::uint8_t>(0, 1) = 1;
  mask.at<std::uint8_t>(3, 3) = 2;
  DynamicMasksWriter writer(folder.path());
  writer.write("7.5", mask, {{1, 2, "person", "chair", 12, 0.03, true}});
  writer.finish();
  CHECK(read_bytes(folder / "interactions.json").find("\"pixel_pairs\":12") != std::string::npos);
  const auto interactions = DynamicMasksReader(folder.path()).interactions();
  REQUIRE(interactions.size() == 1);
  const Interaction& pair = interactions.at("7.5").at(0);
  CHECK((pair.dynamic_id == 1 && pair.static_id == 2 && pair.pixel_pairs == 12 && pair.interacting));
  CHECK((pair.dynamic_class == "person" && pair.static_class == "chair"));
  CHECK(pair.mean_depth_difference_m == 0.03);
  std::filesystem::remove(folder / "interactions.json");
  for (const auto& place : {folder.path(), folder / "masks"}) {
    const DynamicMasksReader reader(place);
    CHECK(reader.has("7.5"));
    CHECK_FALSE(reader.has("8"));
    CHECK(reader.interactions().empty());
    CHECK(cv::norm(reader.read("7.5"), mask, cv::NORM_INF) == 0);
    CHECK_THROWS_WITH(reader.read("8"), Contains("8.png") && Contains("frame 8"));
  }
}

TEST_CASE("a dynamic mask with a value that means nothing is refused") {
  const test::TemporaryFolder folder;
  cv::Mat mask(4, 6, CV_8UC1, cv::Scalar(0));
  mask.at<std::uint8_t>(2, 5) = 255;
  write_png(folder / "masks" / "1.png", mask);
  CHECK_THROWS_WITH(DynamicMasksReader(folder.path()).read("1"), Contains("1.png: pixel (5, 2) is 255"));
  CHECK_THROWS_WITH(DynamicMasksReader(folder / "none"), Contains("none"));
  DynamicMasksWriter writer(folder / "new");
  CHECK_THROWS_WITH(writer.write("1", mask, {}), Contains("frame 1"));
}
