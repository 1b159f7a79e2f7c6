#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "pipeline/artifacts/coco_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;
using Json = nlohmann::json;

namespace {

Json small_file() {
  return {{"images", {{{"id", 3}, {"file_name", "rgb/12.500000.png"}, {"width", 10}, {"height", 9}}}},
          {"categories", {{{"id", 1}, {"name", "person"}}, {{"id", 7}, {"name", "chair"}}}},
          {"annotations",
           {{{"id", 1},
             {"image_id", 3},
             {"category_id", 7},
             {"score", 0.5},
             {"segmentation", {{"size", {9, 10}}, {"counts", "61X13mN000`0"}}}},
            {{"id", 2},
             {"image_id", 3},
             {"category_id", 1},
             {"iscrowd", 1},
             {"segmentation", {{"size", {9, 10}}, {"counts", {0, 2, 88}}}}},
            {{"id", 3}, {"image_id", 3}, {"category_id", 1}, {"segmentation", {{2, 1, 5, 1, 5, 4, 2, 4}}}}}}};
}

struct WrittenCoco {
  test::TemporaryFolder folder;
  std::filesystem::path file = folder / "coco.json";
  explicit WrittenCoco(const Json& json) { std::ofstream(file) << json.dump(); }
};

}  // namespace

TEST_CASE("COCO's run-length text is read and written as its own tools do") {
  // The example of the COCO API: a mask of 10 x 9 pixels.
  const RunLengths lengths = {6, 1, 40, 4, 5, 4, 5, 4, 21};
  CHECK(parse_run_lengths("61X13mN000`0") == lengths);
  CHECK(format_run_lengths(lengths) == "61X13mN000`0");
}

TEST_CASE("run lengths of random masks come back as they were") {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    cv::Mat mask(1 + static_cast<int>(random() % 40), 1 + static_cast<int>(random() % 40), CV_8UC1);
    const unsigned fill = random() % 5;
    for (std::uint8_t& pixel : cv::Mat_<std::uint8_t>(mask)) pixel = random() % 5 < fill ? 255 : 0;
    const RunLengths lengths = run_lengths_of(mask);
    CHECK(parse_run_lengths(format_run_lengths(lengths)) == lengths);
    CHECK(cv::countNonZero(mask_from(lengths, mask.size()) != mask) == 0);
  }
  const cv::Mat large(2000, 2000, CV_8UC1, cv::Scalar(255));
  CHECK(parse_run_lengths(format_run_lengths(run_lengths_of(large))) == RunLengths{0, 4000000});
}

TEST_CASE("damaged run lengths are refused") {
  for (const char* wrong : {"61X", "6 1", "\x7f", "0000O", "oooooooooooooooooo"})
    CHECK_THROWS_WITH(parse_run_lengths(wrong), Contains("run-length code"));
  CHECK_THROWS_WITH(mask_from(RunLengths{5, 5}, {3, 3}), Contains("add up to 10 pixels, expected 3 x 3"));
  CHECK_THROWS(mask_from(RunLengths{4000000000u, 4000000000u}, {3, 3}));
}

TEST_CASE("a polygon has the pixels whose centres it holds") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> at(-5, 35);
  for (int i = 0; i < 100; ++i) {
    std::vector<double> corners;
    for (int k = 0; k < 2 * (3 + i % 5); ++k) corners.push_back(at(random));
    cv::Mat mask = cv::Mat::zeros(30, 30, CV_8UC1);
    fill_polygon(corners, mask);
    for (int row = 0; row < 30; ++row)
      for (int column = 0; column < 30; ++column) {
        bool inside = false;  // even-odd rule, by a ray to the right
        const double x = column + 0.5, y = row + 0.5;
        for (std::size_t a = 0, n = corners.size() / 2; a < n; ++a) {
          const std::size_t b = (a + n - 1) % n;
          const double ax = corners[2 * a], ay = corners[2 * a + 1], bx = corners[2 * b],
                       by = corners[2 * b + 1];
          if ((ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) inside = !inside;
        }
        CHECK((mask.at<std::uint8_t>(row, column) == 255) == inside);
      }
  }
  cv::Mat mask = cv::Mat::zeros(30, 30, CV_8UC1);
  fill_polygon(std::vector<double>{-1e300, -1e300, 1e300, -1e300, 0, 1e300}, mask);  // no overflow
  CHECK_THROWS_WITH(fill_polygon(std::vector<double>{1, 2, 3, 4}, mask), Contains("3 corners at least"));
  CHECK_THROWS(fill_polygon(std::vector<double>{1, 2, 3, 4, 5, NAN}, mask));
}

TEST_CASE("a COCO file gives its images, categories and masks in every form") {
  const WrittenCoco written(small_file());
  const CocoFile coco = read_coco(written.file);
  const CocoImage* image = coco.find("12.500000");
  REQUIRE(image != nullptr);
  CHECK(coco.find("12.5") == nullptr);
  CHECK(image->size == cv::Size(10, 9));
  REQUIRE(image->objects.size() == 3);
  CHECK(image->objects[0].category == "chair");
  CHECK(image->objects[0].score == 0.5);
  CHECK(image->objects[1].score == 1);
  const cv::Mat chair = pixels_of(image->objects[0], *image, coco);
  CHECK(cv::countNonZero(chair) == 13);
  CHECK(chair.at<std::uint8_t>(6, 0) == 255);
  CHECK(chair.at<std::uint8_t>(2, 5) == 255);  // pixel 47, column by column
  CHECK(cv::countNonZero(pixels_of(image->objects[1], *image, coco)) == 2);
  const cv::Mat square = pixels_of(image->objects[2], *image, coco);
  CHECK(cv::countNonZero(square) == 9);
  CHECK(cv::countNonZero(square(cv::Rect(2, 1, 3, 3))) == 9);
}

TEST_CASE("what is wrong in a COCO file is named") {
  const auto refused = [](const Json& json, const std::string& message) {
    const WrittenCoco written(json);
    CHECK_THROWS_WITH(read_coco(written.file), Contains("coco.json is no COCO file") && Contains(message));
  };
  Json json = small_file();
  json["annotations"][1]["category_id"] = 5;
  refused(json, "annotation 2: there is no category with id 5");
  json = small_file();
  json["annotations"][1]["image_id"] = 5;
  refused(json, "annotation 2: there is no image with id 5");
  json = small_file();
  json["images"].push_back(json["images"][0]);
  refused(json, "two images are called 12.500000");
  json = small_file();
  json["annotations"][0]["segmentation"]["size"] = {10, 9};
  refused(json, "annotation 1: its run lengths are of 9 x 10 pixels, its image of 10 x 9");
  json = small_file();
  json["annotations"][2]["segmentation"] = Json::array();
  refused(json, "annotation 3: its segmentation is empty");
  json = small_file();
  json.erase("categories");
  refused(json, "categories");
  refused(Json::array({small_file()["annotations"][0]}), "a list of results names no images");
  const WrittenCoco text("not COCO");
  CHECK_THROWS_WITH(read_coco(text.file), Contains("no COCO file"));

  json = small_file();
  json["annotations"][1]["segmentation"]["counts"] = {0, 2, 80};
  const WrittenCoco short_one(json);
  const CocoFile coco = read_coco(short_one.file);
  CHECK_THROWS_WITH(pixels_of(coco.images[0].objects[1], coco.images[0], coco),
                    Contains("coco.json: rgb/12.500000.png: annotation 2: run lengths add up to 82 pixels"));
}

TEST_CASE("an image is known by its name without folder and extension") {
  CHECK(image_name("a/b/1305031248.197746.png") == "1305031248.197746");
  CHECK(image_name("1305031248.197746") == "1305031248.197746");
  CHECK(image_name("x.JPG") == "x");
}
