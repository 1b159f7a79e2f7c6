#include "pipeline/artifacts/cloud.hpp"

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "pipeline/artifacts/cloud_writer.hpp"
#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

LabelledCloud some_cloud(std::size_t count) {
  LabelledCloud cloud(count);
  for (std::size_t i = 0; i < count; ++i) {
    LabelledPoint& p = cloud[i];
    p.x = 0.1f * static_cast<float>(i);
    p.y = -std::sqrt(static_cast<float>(i));
    p.z = 1e-6f * static_cast<float>(i * i);
    p.b = static_cast<std::uint8_t>(i);
    p.g = static_cast<std::uint8_t>(3 * i);
    p.r = static_cast<std::uint8_t>(7 * i);
    p.label = i % 3 == 0 ? kUnlabelled : 56;
    p.instance = static_cast<std::uint32_t>(i % 5);
  }
  return cloud;
}

}  // namespace

TEST_CASE("a cloud survives writing and reading in every encoding, and PCL reads the same points") {
  const auto encoding = GENERATE(PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed);
  const std::size_t count = GENERATE(1, 1000);
  const test::TemporaryFolder folder;
  const LabelledCloud cloud = some_cloud(count);
  write_cloud(folder.path(), cloud, default_labels(), encoding);
  CHECK(read_cloud(folder.path()) == cloud);

  pcl::PointCloud<pcl::PointXYZRGBL> read;
  REQUIRE(pcl::io::loadPCDFile((folder / "cloud.pcd").string(), read) == 0);
  REQUIRE(read.size() == count);
  for (std::size_t i = 0; i < count; ++i) {
    REQUIRE(read[i].x == cloud[i].x);
    REQUIRE(read[i].y == cloud[i].y);
    REQUIRE(read[i].z == cloud[i].z);
    REQUIRE(read[i].label == cloud[i].label);
    REQUIRE(int{read[i].r} == int{cloud[i].r});
    REQUIRE(int{read[i].g} == int{cloud[i].g});
    REQUIRE(int{read[i].b} == int{cloud[i].b});
  }
}

TEST_CASE("a cloud written in pieces has the bytes of one written at once") {
  const auto encoding = GENERATE(PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed);
  const test::TemporaryFolder folder;
  const LabelledCloud cloud = some_cloud(1000);
  write_cloud(folder / "whole", cloud, default_labels(), encoding);
  CloudWriter writer(folder / "pieces", encoding);
  for (const auto& [from, count] : {std::pair{0, 1}, {1, 0}, {1, 700}, {701, 299}})
    writer.append(std::span(cloud).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(count)));
  CHECK(writer.size() == 1000);
  writer.finish(default_labels());
  for (const char* name : {"cloud.pcd", "labels.csv"})
    CHECK(read_bytes(folder / "pieces" / name) == read_bytes(folder / "whole" / name));
}

TEST_CASE("an empty cloud is a cloud") {
  const auto encoding = GENERATE(PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed);
  const test::TemporaryFolder folder;
  write_cloud(folder.path(), {}, default_labels(), encoding);
  CHECK(read_cloud(folder.path()).empty());
  CHECK(read_cloud_labels(folder.path()).labels().empty());
}

TEST_CASE("the labels that occur stand beside the cloud, whatever characters their names have") {
  const test::TemporaryFolder folder;
  const LabelTable labels(
      {{56, "chair", {230, 25, 25}, false}, {7, "box, \"small\"", {1, 2, 3}, false}, {8, "x", {}, false}});
  LabelledCloud cloud(3);
  cloud[0].label = 56;
  cloud[1].label = 7;
  write_cloud(folder.path(), cloud, labels, PcdEncoding::binary);
  const LabelTable read = read_cloud_labels(folder.path());
  REQUIRE(read.labels().size() == 2);
  CHECK(read.find("box, \"small\"")->id == 7);
  CHECK(read.find(56u)->rgb == std::array<std::uint8_t, 3>{230, 25, 25});
}

TEST_CASE("clouds of other programs are read: doubles, rgba, other ids, more fields, normals between") {
  const test::TemporaryFolder folder;
  const auto file = folder / "cloud.pcd";
  write_bytes(file,
              {"# .PCD v.7 - Point Cloud Data file format\r\nVERSION .7\r\nFIELDS normal x y z label\r\n"
               "SIZE 4 8 4 4 2\r\nTYPE F F F F U\r\nCOUNT 3 1 1 1 1\r\nWIDTH 2\r\nHEIGHT 1\r\n"
               "POINTS 2\r\nDATA ascii\r\n0 0 1 1.5 2.5 -3 9\r\n0 0 1 nan nan nan 65535\r\n"});
  const LabelledCloud cloud = read_pcd(file);
  REQUIRE(cloud.size() == 2);
  CHECK(cloud[0].x == 1.5f);
  CHECK(cloud[0].z == -3.0f);
  CHECK(cloud[0].label == 9);
  CHECK(cloud[0].r == 128);
  CHECK(std::isnan(cloud[1].y));
  CHECK(cloud[1].label == 65535);
  CHECK(cloud[1].instance == 0);
}

TEST_CASE("a PCD file that PCL has written is read") {
  const bool binary = GENERATE(false, true);
  const test::TemporaryFolder folder;
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  cloud.emplace_back(1.0f, 2.0f, 3.0f, 10, 20, 30);
  cloud.emplace_back(-1.0f, 0.25f, 1e6f, 255, 0, 1);
  pcl::io::savePCDFile((folder / "c.pcd").string(), cloud, binary);
  const LabelledCloud read = read_pcd(folder / "c.pcd");
  REQUIRE(read.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(read[i].x == cloud[i].x);
    CHECK(read[i].z == cloud[i].z);
    CHECK(int{read[i].r} == int{cloud[i].r});
    CHECK(int{read[i].g} == int{cloud[i].g});
    CHECK(int{read[i].b} == int{cloud[i].b});
    CHECK(read[i].label == kUnlabelled);
  }
}

TEST_CASE("a cloud file that is cut off, of another version or no cloud is refused by name") {
  const test::TemporaryFolder folder;
  const auto file = folder / "cloud.pcd";
  const auto encoding = GENERATE(PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed);
  write_pcd(file, some_cloud(100), encoding);
  const std::string whole = read_bytes(file);
  const auto replaced = [&](const std::string& what, const std::string& by) {
    std::string text = whole;
    return text.replace(text.find(what), what.size(), by);
  };
  std::string damaged, expected;
  SECTION("cut off in the points") {
    damaged = whole.substr(0, whole.size() - 30);
    expected = "truncated";
  }
  SECTION("cut off in the header") {
    damaged = whole.substr(0, 100);
    expected = "header";
  }
  SECTION("more points than there are") {
    damaged = replaced("POINTS 100", "POINTS 99999999999");
    expected = "truncated";
  }
  SECTION("another version") {
    damaged = replaced("VERSION 0.7", "VERSION 0.9");
    expected = "version 0.9";
  }
  SECTION("no z") {
    damaged = replaced("FIELDS x y z", "FIELDS x y w");
    expected = "no x y z";
  }
  SECTION("text of another kind") {
    damaged = "<html>not found</html>\n";
    expected = "not a PCD file";
  }
  SECTION("empty file") {
    expected = "not a whole PCD file";
  }
  write_bytes(file, {damaged});
  CHECK_THROWS_WITH(read_cloud(folder.path()), Contains(file.string()) && Contains(expected));
}
