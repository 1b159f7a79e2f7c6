#include <catch2/catch.hpp>
#include <cstdlib>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/stages/sor/test_clouds.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;

namespace {

int run(const std::string& arguments) {
  return WEXITSTATUS(std::system((SEDIMENT_BINARY_DIR "/sor " + arguments + " 2>/dev/null").c_str()));
}

}  // namespace

TEST_CASE("the stage sor writes equal bytes with 1 and with 4 threads") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in");
  write_cloud(folder / "in", test::noisy_room(20000, 5), default_labels(), PcdEncoding::binary);
  const std::string in = "--cloud " + (folder / "in").string();
  REQUIRE(run(in + " --threads 1 --out " + (folder / "one").string()) == 0);
  REQUIRE(run(in + " --threads 4 --out " + (folder / "four").string()) == 0);
  CHECK(contract::read_manifest(folder / "one").id() == contract::read_manifest(folder / "four").id());
  const LabelledCloud kept = read_cloud(folder / "one");
  CHECK(kept.size() > 19000);
  CHECK(kept.size() < 20000);
}

TEST_CASE("the stage sor takes an empty cloud and refuses wrong calls") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "empty");
  write_cloud(folder / "empty", {}, default_labels(), PcdEncoding::binary);
  const std::string in = "--cloud " + (folder / "empty").string() + " --out " + (folder / "out").string();
  CHECK(run(in) == 0);
  CHECK(read_cloud(folder / "out").empty());
  CHECK(run(in + " --neighbors 0") == 2);
  CHECK(run(in + " --rule sideways") == 2);
  CHECK(run("--cloud /nowhere --out " + (folder / "out").string()) == 2);
}
