#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "tests/support/needs.hpp"
#include "tests/tools/evaluate-map/small_room.hpp"
#include "tools/truth/ply_file.hpp"

using namespace sediment;
using namespace sediment::tools;
using Catch::Matchers::Contains;

TEST_CASE("vertices of a PLY file are read, ascii and binary, whatever stands beside them") {
  const test::TemporaryFolder folder;
  const auto file = folder / "c.ply";
  const std::string properties =
      "element vertex 2\nproperty float nx\nproperty double x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar label\nelement face 0\n"
      "property list uchar int vertex_indices\nend_header\n";
  if (GENERATE(true, false)) {
    write_bytes(file,
                {"ply\nformat ascii 1.0\ncomment x\n", properties, "9 1.5 2 3 200 56\n9 -1 0 0 1 255\n"});
  } else {
    std::string body;
    const auto add = [&](auto value) { body.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (const auto& [x, y, z, red, label] :
         {std::tuple{1.5, 2.0f, 3.0f, 200, 56}, {-1.0, 0.0f, 0.0f, 1, 255}}) {
      add(9.0f);
      add(x);
      add(y);
      add(z);
      add(static_cast<std::uint8_t>(red));
      add(static_cast<std::uint8_t>(label));
    }
    write_bytes(file, {"ply\nformat binary_little_endian 1.0\n", properties, body});
  }
  const LabelledCloud cloud = read_ply(file);
  REQUIRE(cloud.size() == 2);
  CHECK(cloud[0].x == 1.5f);
  CHECK(cloud[0].y == 2.0f);
  CHECK(cloud[0].z == 3.0f);
  CHECK(int{cloud[0].r} == 200);
  CHECK(cloud[0].label == 56);
  CHECK(cloud[1].x == -1.0f);
  CHECK(cloud[1].label == 255);
}

TEST_CASE("a damaged PLY file is refused by name") {
  const test::TemporaryFolder folder;
  const auto file = folder / "c.ply";
  const std::string begin = "ply\nformat ascii 1.0\nelement vertex 2\n";
  const auto [text, expected] = GENERATE_COPY(table<std::string, std::string>(
      {{"", "not a PLY file"},
       {begin, "truncated header"},
       {begin + "property float x\nend_header\n", "no x y z"},
       {begin + "property float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n", "truncated"},
       {begin + "property list uchar int x\nend_header\n", "list"},
       {"ply\nformat binary_big_endian 1.0\n", "binary_big_endian"}}));
  write_bytes(file, {text});
  CHECK_THROWS_WITH(read_ply(file), Contains(file.string()) && Contains(expected));
}

TEST_CASE("labels of a PLY truth are brought to the default ones by their names") {
  const test::SmallRoom room;
  const auto truth = room.folder / "truth";
  std::filesystem::remove_all(truth / "static_cloud");
  write_bytes(
      truth / "static_cloud.ply",
      {"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
       "property uchar label\nend_header\n0 0 0 56\n0 0 0 105\n0 0 0 110\n0 0 0 107\n"});
  write_bytes(
      truth / "instances.json",
      {R"({"labels": {"56": "chair", "105": "desk", "107": "floor", "110": "partition"}, "instances": []})"});
  const LabelledCloud cloud = room.open().static_cloud;
  REQUIRE(cloud.size() == 4);
  CHECK(cloud[0].label == 56);
  CHECK(cloud[1].label == default_labels().find("desk")->id);
  CHECK(cloud[2].label == default_labels().find("other furniture")->id);
  CHECK(cloud[3].label == default_labels().find("floor")->id);
}

TEST_CASE("a truth that is not whole is refused by what is missing") {
  const test::SmallRoom room;
  std::string expected;
  SECTION("no static surfaces") {
    std::filesystem::remove_all(room.folder / "truth" / "static_cloud");
    expected = "neither static_cloud/ nor static_cloud.ply";
  }
  SECTION("no dynamic masks") {
    std::filesystem::remove_all(room.folder / "truth" / "dynamic");
    expected = "dynamic: there is no such folder";
  }
  SECTION("no ground truth of these frames") {
    write_bytes(room.folder / "groundtruth.txt", {"5 0 0 0 0 0 0 1\n"});
    expected = "has no pose of any frame";
  }
  SECTION("no ground truth named") {
    const std::string yaml = read_bytes(room.folder / "sequence.yaml");
    write_bytes(room.folder / "sequence.yaml", {yaml.substr(0, yaml.find("groundtruth"))});
    expected = "names no groundtruth";
  }
  CHECK_THROWS_WITH(room.open(), Contains(expected));
}

TEST_CASE("a rendered twin opens with its truth") {
  const auto twin = test::needs("twins/twin_sitting_static");
  if (!twin) return;
  const test::TemporaryFolder folder;
  write_bytes(folder / "twin.yaml",
              {"root: ", twin->string(), "\ncamera: " SEDIMENT_SOURCE_DIR "/configs/cameras/freiburg3.yaml\n",
               "groundtruth: groundtruth.txt\n"});
  const TrueSequence truth = open_true_sequence(folder / "twin.yaml");
  CHECK(truth.sequence.size() == 90);
  CHECK(truth.static_cloud.size() > 100000);
  CHECK(truth.instances);
  for (const auto& pose : truth.world_from_camera) CHECK(pose);
}
