#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/dynamic_masks.hpp"
#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/masks.hpp"
#include "tests/support/needs.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

std::string quoted(const std::filesystem::path& path) {
  return "'" + path.string() + "' ";
}

cv::Mat image_with_box(cv::Rect box, int type = CV_8UC1) {
  cv::Mat mask(48, 64, type, cv::Scalar(0));
  mask(box).setTo(1);
  return mask;
}

}  // namespace

TEST_CASE("figures are printed as tables, as JSON and as a picture") {
  const test::TemporaryFolder folder;
  for (const char* stamp : {"1.25", "1.5"}) {
    write_png(folder / "truth" / (std::string(stamp) + ".png"), image_with_box({0, 0, 20, 20}));
    write_png(folder / "run" / "masks" / (std::string(stamp) + ".png"), image_with_box({10, 0, 20, 20}));
  }
  const std::string both = quoted(folder / "truth") + quoted(folder / "run");
  const auto text = test::run_program("evaluate-masks", both + "--plot " + quoted(folder / "p.png"));
  CHECK(text.code == 0);
  CHECK_THAT(text.output, Contains("IoU") && Contains("0.3333") && Contains("missed frames 0 of 2"));
  CHECK(probe_image(folder / "p.png").width > 600);
  const auto json = nlohmann::json::parse(test::run_program("evaluate-masks", both + "--json").output);
  CHECK(json["iou"].get<double>() == Approx(1.0 / 3));
  CHECK(json["precision"] == 0.5);
  CHECK(json["recall"] == 0.5);
  CHECK(json["missed_frames"] == 0);
  CHECK(json["over_time"].size() == 2);
  CHECK(json["recall_non_prior"].is_null());
}

TEST_CASE("true instances are compared with found ones") {
  const test::TemporaryFolder folder;
  for (const char* name : {"truth", "found"}) {
    MasksWriter writer(folder / name);
    writer.write("1", {image_with_box({0, 0, 30, 30}, CV_16UC1), {{1, "person", 1, {}}}});
    writer.finish();
  }
  const std::string both = quoted(folder / "truth") + quoted(folder / "found");
  const auto json = nlohmann::json::parse(test::run_program("evaluate-masks", both + "--json").output);
  CHECK(json["classes"]["person"]["mean_iou"] == 1.0);
  CHECK(json["classes"]["person"]["identity_switches"] == 0);
  CHECK_THAT(test::run_program("evaluate-masks", both).output, Contains("person"));
  write_png(folder / "dynamic" / "1.png", image_with_box({0, 0, 30, 30}));
  CHECK(test::run_program("evaluate-masks", quoted(folder / "truth") + quoted(folder / "dynamic")).code == 2);
}

TEST_CASE("a wrong call of evaluate-masks ends with code 2, help with 0, a missing folder with 1") {
  CHECK(test::run_program("evaluate-masks", "").code == 2);
  CHECK(test::run_program("evaluate-masks", "a b --what").code == 2);
  CHECK(test::run_program("evaluate-masks", "--help").code == 0);
  const auto outcome = test::run_program("evaluate-masks", "nowhere1 nowhere2");
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.output, Contains("nowhere1: there is no such folder"));
}

TEST_CASE("the truth of a rendered twin agrees with itself, mover by mover") {
  const auto twin = test::needs("twins/twin_sitting_static");
  if (!twin) return;
  const auto dynamic = *twin / "truth" / "dynamic";
  const auto outcome = test::run_program("evaluate-masks", quoted(dynamic) + quoted(dynamic) + "--json");
  const auto json = nlohmann::json::parse(outcome.output);
  CHECK(json["frames"] == 90);
  CHECK(json["recall"] == 1.0);
  CHECK(json["classes"]["person"]["dynamic_pixels"].get<int>() > 0);
  CHECK(json["classes"]["person"]["static_pixels"] == 0);
  CHECK(json["frames_with_mover"] == 90);
}
