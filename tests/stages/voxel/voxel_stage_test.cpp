#include <catch2/catch.hpp>
#include <cstdlib>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;

namespace {

int run(const std::string& arguments) {
  return WEXITSTATUS(std::system((SEDIMENT_BINARY_DIR "/voxel " + arguments + " 2>/dev/null").c_str()));
}

}  // namespace

TEST_CASE("the stage voxel writes equal bytes with 1 and with 4 threads") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in");
  LabelledCloud cloud(30000, LabelledPoint{});
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud[i].x = (static_cast<float>(i % 173) + 0.5f) * 0.01f,
    cloud[i].y = (static_cast<float>(i % 59) + 0.5f) * 0.01f;
  write_cloud(folder / "in", cloud, default_labels(), PcdEncoding::binary);
  const std::string in = "--cloud " + (folder / "in").string();
  REQUIRE(run(in + " --leaf 0.01 --threads 1 --out " + (folder / "one").string()) == 0);
  REQUIRE(run(in + " --leaf 0.01 --threads 4 --out " + (folder / "four").string()) == 0);
  CHECK(contract::read_manifest(folder / "one").id() == contract::read_manifest(folder / "four").id());
  CHECK(read_cloud(folder / "one").size() == 173 * 59);
}

TEST_CASE("the stage voxel takes an empty cloud and refuses wrong calls") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "empty");
  write_cloud(folder / "empty", {}, default_labels(), PcdEncoding::binary);
  const std::string in = "--cloud " + (folder / "empty").string() + " --out " + (folder / "out").string();
  CHECK(run(in) == 0);
  CHECK(read_cloud(folder / "out").empty());
  CHECK(run(in + " --leaf 0") == 2);
  CHECK(run(in + " --leaf nan") == 2);
  CHECK(run("--cloud /nowhere --out " + (folder / "out").string()) == 2);
}
