#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "pipeline/contract/manifest.hpp"
#include "tests/support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace sediment::contract;
using sediment::test::TemporaryFolder;

namespace {

void fill(const TemporaryFolder& folder) {
  fs::create_directories(folder / "masks");
  std::ofstream(folder / "masks/2.png") << "two";
  std::ofstream(folder / "masks/1.png") << "one";
  std::ofstream(folder / "a.json") << "{}";
}

}  // namespace

TEST_CASE("a manifest lists every file but itself, sorted, and reads back equal") {
  const TemporaryFolder folder;
  fill(folder);
  const Manifest manifest = manifest_of(folder.path(), "segment");
  REQUIRE(manifest.files.size() == 3);
  CHECK(manifest.files[0].path == "a.json");
  CHECK(manifest.files[1].path == "masks/1.png");
  CHECK(manifest.bytes() == 8);
  write_manifest(manifest, folder.path());
  CHECK(read_manifest(folder.path()).files == manifest.files);
  CHECK(manifest_of(folder.path(), "segment").files == manifest.files);
}

TEST_CASE("the id of a folder changes with content and names, and with nothing else") {
  const TemporaryFolder one, other;
  fill(one);
  fill(other);
  const std::string id = manifest_of(one.path(), "segment").id();
  fs::last_write_time(other / "a.json", fs::file_time_type::clock::now() - std::chrono::hours(5));
  CHECK(manifest_of(other.path(), "another").id() == id);
  fs::rename(other / "a.json", other / "b.json");
  CHECK(manifest_of(other.path(), "segment").id() != id);
  std::ofstream(one / "a.json") << "[]";
  CHECK(manifest_of(one.path(), "segment").id() != id);
}

TEST_CASE("a manifest that is missing, cut off or edited is an error that names the file") {
  const TemporaryFolder folder;
  fill(folder);
  CHECK_THROWS_WITH(read_manifest(folder.path()), Catch::Contains("manifest.json"));
  write_manifest(manifest_of(folder.path(), "segment"), folder.path());
  std::ifstream stream(folder / "manifest.json");
  std::string text((std::istreambuf_iterator<char>(stream)), {});
  std::ofstream(folder / "manifest.json") << text.substr(0, text.size() / 2);
  CHECK_THROWS_WITH(read_manifest(folder.path()), Catch::Contains("is no manifest"));
  text.replace(text.find("\"bytes\": 3"), 10, "\"bytes\": 4");
  std::ofstream(folder / "manifest.json") << text;
  CHECK_THROWS_WITH(read_manifest(folder.path()), Catch::Contains("does not match"));
}
