#include "tools/tabulate/paper_tables.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/support/temporary_folder.hpp"
#include "tools/tabulate/map_sizes.hpp"
#include "tools/tabulate/paper_figures.hpp"

using namespace sediment;
using namespace sediment::tabulate;
using Json = nlohmann::json;

namespace {

Json stage(const std::string& name, const Json& files, const Json& params, const Json& metrics) {
  return {{"name", name},       {"key", "x3:" + name + "0123456789"},
          {"folder", "/"},      {"outputs", Json::array()},
          {"files", files},     {"params", params},
          {"metrics", metrics}, {"wall_s", 1.5},
          {"peak_bytes", 1000}, {"inputs", Json::array()}};
}

/// 1000 points of 24 bytes, of which SOR removes 10 and the voxel filter leaves `left`.
Json instance(const std::string& sequence, double leaf, double resolution, int left, int tree_bytes) {
  return {{"name", sequence},
          {"values", Json::array({Json::array({"sequence", sequence})})},
          {"stages",
           {stage("fuse", {{"cloud.pcd", 24000}},
                  {{"frames", "keyframes"},
                   {"every_nth", 5},
                   {"min_depth_m", 0.4},
                   {"max_depth_m", 5},
                   {"pixel_step", 2}},
                  {{"points", 1000}, {"frames_fused", 7}}),
            stage("sor", {{"cloud.pcd", 23760}}, {{"neighbors", 50}, {"sigmas", 2.5}, {"rule", "two-sided"}},
                  {{"points_written", 990}}),
            stage("voxel", {{"cloud.pcd", 24 * left}}, {{"leaf", leaf}, {"encoding", "binary"}},
                  {{"points_written", left}}),
            stage("octree", {{"map.ot", tree_bytes}, {"map.bt", 100}}, {{"resolution_m", resolution}},
                  {{"leaves", 90}})}}};
}

RunFacts facts_of(const std::vector<Json>& instances) {
  const test::TemporaryFolder folder;
  Json json = {{"format", "sediment-report-facts 1"}, {"name", "sizes"}, {"instances", Json::array()}};
  for (Json one : instances) {
    for (Json& each : one["stages"]) {
      Json files = Json::array();
      for (const auto& [file, bytes] : each["files"].items()) files.push_back({file, bytes});
      each["files"] = files;
    }
    json["instances"].push_back(one);
  }
  std::ofstream(folder / "facts.json") << json;
  return read_run_facts(folder / "facts.json");
}

}  // namespace

TEST_CASE("the paper's table has its figures, and its ratios are those it prints") {
  const double printed[] = {18, 18.2, 20.4, 50, 30.5, 39.4, 25.9};
  std::size_t n = 0;
  for (const PaperSequence& one : paper_sequences())
    if (one.ratio()) CHECK(std::abs(100 * *one.ratio() - printed[n++]) < 0.06);
  CHECK(n == 7);
  CHECK(paper_sequence("rgbd_dataset_freiburg3_walking_rpy") != nullptr);
  CHECK(paper_sequence("rgbd_dataset_freiburg1_rpy") == nullptr);
}

TEST_CASE("sizes, shares and receipts are those of the files, and missing sequences are named") {
  const RunFacts base[] = {facts_of({instance("rgbd_dataset_freiburg3_walking_rpy", 0.01, 0.05, 390, 4800)})};
  const PaperTables tables = paper_tables(base, {});
  const auto& row = tables.sizes.rows.at(0);
  const auto column = [&](const std::string& name) {
    for (std::size_t i = 0; i < tables.sizes.headings.size(); ++i)
      if (tables.sizes.headings[i] == name) return *row[i].number;
    throw std::out_of_range(name);
  };
  CHECK(row[0].text == "fr3/w/rpy");
  CHECK(column("dense [MB]") == Approx(0.024));
  CHECK(column("left [%]") == Approx(39));
  CHECK(column("of dense [%]") == Approx(20));
  CHECK(column("paper: left [%]") == Approx(100 * 7.6 / 19.3));
  CHECK(tables.sor.rows.at(0).back().number == Approx(1));
  CHECK(tables.missing.size() == 7);
  CHECK(tables.receipts.rows.at(0).back().text == "x3:fuse0123 x3:sor01234 x3:voxel012 x3:octree01");
  const std::string page = paper_page(tables, "chart.svg");
  CHECK(page.find("fr2/rpy (rgbd_dataset_freiburg2_rpy)") != std::string::npos);
}

TEST_CASE("a setting that gives the paper's ratio is set in bold, one that does not is not") {
  const std::string name = "rgbd_dataset_freiburg3_walking_rpy";  // 39.4 % in the paper
  const RunFacts base[] = {facts_of({instance(name, 0.01, 0.05, 800, 4800)})};
  const RunFacts bands[] = {
      facts_of({instance(name, 0.02, 0.05, 400, 4800), instance(name, 0.01, 0.1, 800, 2400)})};
  const PaperTables tables = paper_tables(base, bands);
  CHECK(tables.leaf_band.headings ==
        std::vector<std::string>{"sequence", "frames fused", "0.01 m", "0.02 m"});
  CHECK(tables.leaf_band.rows.at(0).at(2).text == "80.0");
  CHECK(tables.leaf_band.rows.at(0).at(3).text == "**40.0**");
  CHECK(tables.tree_band.rows.at(0).at(2).text == "**20.0**");
  CHECK(tables.tree_band.rows.at(0).at(3).text == "10.0");
}

TEST_CASE("sweeps without maps are an error, not an empty table") {
  RunFacts nothing;
  CHECK_THROWS_WITH(paper_tables(std::span(&nothing, 1), {}), Catch::Contains("fuse, sor, voxel and octree"));
}
