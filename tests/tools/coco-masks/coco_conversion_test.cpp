#include "tools/coco-masks/coco_conversion.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "pipeline/artifacts/masks.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

/// Three frames of random ids, one of them without instances. Scores descend with the ids.
void write_random_masks(const std::filesystem::path& folder) {
  std::mt19937 random(1);
  MasksWriter writer(folder);
  for (int frame = 0; frame < 3; ++frame) {
    InstanceMask mask{cv::Mat::zeros(30, 40, CV_16UC1), {}};
    if (frame != 1)
      for (int id = 1; id <= 3; ++id) {
        mask.instances.push_back({id, id == 2 ? "person" : "chair", 1.0 / id, {}});
        for (int k = 0; k < 200; ++k)
          mask.ids.at<std::uint16_t>(static_cast<int>(random() % 30), static_cast<int>(random() % 40)) =
              static_cast<std::uint16_t>(id);
      }
    writer.write("10." + std::to_string(frame) + "00000", mask);
  }
  writer.finish();
}

}  // namespace

TEST_CASE("masks come back from COCO pixel by pixel") {
  const test::TemporaryFolder folder;
  write_random_masks(folder / "masks");
  tools::export_coco(folder / "masks", folder / "coco.json");
  tools::import_coco(folder / "coco.json", folder / "back");
  const MasksReader before(folder / "masks"), after(folder / "back");
  REQUIRE(after.size() == 3);
  for (const std::string stamp : {"10.000000", "10.100000", "10.200000"}) {
    const InstanceMask a = before.read(stamp), b = after.read(stamp);
    CHECK(cv::countNonZero(a.ids != b.ids) == 0);
    REQUIRE(a.instances.size() == b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
      CHECK(a.instances[i].class_name == b.instances[i].class_name);
      CHECK(a.instances[i].score == b.instances[i].score);
    }
  }
  CHECK_FALSE(std::filesystem::exists((folder / "back").string() + ".partial"));
}

TEST_CASE("the COCO file says what COCO's programs ask for") {
  const test::TemporaryFolder folder;
  write_random_masks(folder / "masks");
  tools::export_coco(folder / "masks", folder / "coco.json");
  const auto json = nlohmann::json::parse(std::ifstream(folder / "coco.json"));
  CHECK(json["images"].size() == 3);
  CHECK(json["images"][2] ==
        nlohmann::json({{"id", 3}, {"file_name", "10.200000.png"}, {"width", 40}, {"height", 30}}));
  CHECK(json["categories"] ==
        nlohmann::json({{{"id", 1}, {"name", "chair"}}, {{"id", 2}, {"name", "person"}}}));
  REQUIRE(json["annotations"].size() == 6);
  const InstanceMask mask = MasksReader(folder / "masks").read("10.200000");
  CHECK(json["annotations"][4]["area"] == cv::countNonZero(mask.ids == 2));
  CHECK(json["annotations"][4]["category_id"] == 2);
  CHECK(json["annotations"][4]["image_id"] == 3);
  CHECK(json["annotations"][4]["segmentation"]["size"] == nlohmann::json({30, 40}));
}

TEST_CASE("coco-masks refuses wrong calls, missing files and folders with something in them") {
  const test::TemporaryFolder folder;
  write_random_masks(folder / "masks");
  const auto run = [&](const std::string& arguments) { return test::run_program("coco-masks", arguments); };
  CHECK(run("").code == 2);
  CHECK(run("convert a b").code == 2);
  CHECK(run("--help").code == 0);
  const std::string masks = "'" + (folder / "masks").string() + "'",
                    file = "'" + (folder / "coco.json").string() + "'";
  const test::Outcome missing = run("export '" + (folder / "none").string() + "' " + file);
  CHECK(missing.code == 1);
  CHECK_THAT(missing.output, Contains("none"));
  REQUIRE(run("export " + masks + " " + file).code == 0);
  const test::Outcome full = run("import " + file + " " + masks);
  CHECK(full.code == 2);
  CHECK_THAT(full.output, Contains("masks is not empty"));
  CHECK(run("import " + file + " '" + (folder / "back").string() + "'").code == 0);
}
