#include "pipeline/runner/store/source_content.hpp"

#include <catch2/catch.hpp>

#include "pipeline/contract/digest.hpp"
#include "pipeline/contract/manifest.hpp"
#include "tests/pipeline/runner/workbench.hpp"

namespace fs = std::filesystem;
using namespace sediment::runner;
using sediment::test::Workbench;

namespace {

std::string id_of(const std::string& kind, const fs::path& path) {
  StatMemory memory("");
  FileDigests digests(memory, false);
  return source_id(kind, source_path(kind, path), digests);
}

}  // namespace

TEST_CASE("a file is known by its digest and a folder as its manifest would know it") {
  const Workbench bench;
  CHECK(id_of("file", bench / "data/rgb/1.png") == sediment::contract::digest_bytes("rgb/1.png"));
  const auto manifest = sediment::contract::manifest_of(bench / "data", "any");
  CHECK(id_of("file", bench / "data") == manifest.id());
  sediment::contract::write_manifest(manifest, bench / "data");
  CHECK(id_of("cloud", bench / "data") == manifest.id());
}

TEST_CASE("a sequence is the same wherever its YAML and its root lie") {
  const Workbench bench;
  const std::string here = id_of("sequence", bench / "data");
  bench.write("configs/other.yaml",
              "# a remark\ncamera: {width: 4}\nroot: " + (bench / "data").string() + "\n");
  CHECK(id_of("sequence", bench / "configs/other.yaml") == here);
  bench.write("configs/camera.yaml", "width: 4\n");
  bench.write("configs/other.yaml", "camera: camera.yaml\nroot: ../data\n");
  const std::string by_file = id_of("sequence", bench / "configs/other.yaml");
  bench.write("configs/cam2.yaml", "width: 4\n");
  bench.write("configs/other.yaml", "camera: cam2.yaml\nroot: ../data\n");
  CHECK(id_of("sequence", bench / "configs/other.yaml") == by_file);
  bench.write("configs/cam2.yaml", "width: 5\n");
  CHECK(id_of("sequence", bench / "configs/other.yaml") != by_file);
}

TEST_CASE("everything that a sequence points at is part of its id") {
  const Workbench bench;
  bench.write("data/sequence.yaml",
              "root: .\ncamera: {width: 4}\ngroundtruth: truth.txt\nwindow: {start: 1}\n");
  bench.write("data/truth.txt", "1 2 3\n");
  const std::string before = id_of("sequence", bench / "data");
  const auto change =
      GENERATE(as<std::string>{}, "echo >>data/truth.txt", "echo >>data/rgb/1.png", "rm data/rgb/2.png",
               "echo >>data/depth.txt", "sed -i 's/start: 1/start: 2/' data/sequence.yaml");
  bench.shell(change);
  INFO(change);
  CHECK(id_of("sequence", bench / "data") != before);
}

TEST_CASE("the images of a list count however its columns are parted") {
  const Workbench bench;
  const auto separator = GENERATE(as<std::string>{}, " ", "\t", ",", ", ", " \t ");
  const auto end = GENERATE(as<std::string>{}, "\n", "\r\n");
  const std::string list =
      "# stamp file" + end + "1.0" + separator + "rgb/1.png" + end + "2.0" + separator + "rgb/2.png";
  bench.write("data/rgb.txt", list);
  const std::string before = id_of("sequence", bench / "data");
  bench.write("data/rgb/2.png", "another");
  CHECK(id_of("sequence", bench / "data") != before);
}
