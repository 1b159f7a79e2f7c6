#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/stages/project2d/map_server_loader.hpp"
#include "tests/stages/project2d/test_rooms.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;

namespace {

int run(const std::string& arguments) {
  return WEXITSTATUS(std::system((SEDIMENT_BINARY_DIR "/project2d " + arguments + " 2>/dev/null").c_str()));
}

nlohmann::json json_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

}  // namespace

TEST_CASE(
    "the stage project2d writes equal bytes with 1 and with 4 threads, and says how it found the ground") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in");
  write_cloud(folder / "in", test::test_room(4, test::room_from_test_camera(25).inverse(), 5),
              default_labels(), PcdEncoding::binary);
  const std::string in = "--cloud " + (folder / "in").string();
  REQUIRE(run(in + " --threads 1 --out " + (folder / "one").string()) == 0);
  REQUIRE(run(in + " --threads 4 --out " + (folder / "four").string()) == 0);
  CHECK(contract::read_manifest(folder / "one").id() == contract::read_manifest(folder / "four").id());
  CHECK_THAT(json_of(folder / "one" / "ground.json").at("source").get<std::string>(),
             Catch::Contains("floor"));
  CHECK(json_of(folder / "one" / "metrics.json").at("ground").at("is_floor") == true);
  const test::OccupancyGrid grid = test::load_as_map_server(folder / "one" / "map.yaml");
  CHECK(std::count(grid.values.begin(), grid.values.end(), 100) > 100);
}

TEST_CASE("the stage project2d fails without a ground, and takes one given by hand") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in");
  write_cloud(folder / "in", LabelledCloud(3, LabelledPoint{}), default_labels(), PcdEncoding::binary);
  const std::string in = "--cloud " + (folder / "in").string() + " --out " + (folder / "out").string();
  CHECK(run(in) == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
  CHECK(run(in + " --ground '0 0 1 0.5'") == 0);
  CHECK(json_of(folder / "out" / "ground.json").at("source") == "given");
  CHECK(run(in + " --ground upwards") == 2);
  CHECK(run(in + " --ground '0 0 1 0.5' --min-height 2") == 2);
  CHECK(run(in + " --resolution 0") == 2);
}
