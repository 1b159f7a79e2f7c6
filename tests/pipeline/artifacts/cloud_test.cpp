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
