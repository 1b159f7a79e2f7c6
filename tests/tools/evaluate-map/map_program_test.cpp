#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/cloud.hpp"
#include "pipeline/artifacts/grid_map.hpp"
#include "pipeline/artifacts/label_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/tools/evaluate-map/small_room.hpp"

using namespace sediment;
using Catch::Matchers::Contains;
using sediment::test::operator+;

namespace {

std::string quoted(const std::filesystem::path& path) {
  return "'" + path.string() + "' ";
}

test::Outcome evaluate(const std::string& arguments) {
  return test::run_program("evaluate-map", arguments);
}

}  // namespace

TEST_CASE("maps of a run are brought into the world of the truth by the trajectory beside them") {
  const test::SmallRoom room;
  const auto run = room.folder / "run";
  const Pose away = pose_from({0, 0, 1, 1}, {5, 5, 5});
  const tools::TrueSequence truth = room.open();
  Trajectory trajectory;
  for (std::size_t i = 0; i < truth.sequence.size(); ++i)
    trajectory.push_back(
        {truth.sequence.entry(i).stamp, truth.sequence.entry(i).stamp_s, away * *truth.world_from_camera[i]});
  write_trajectory(run / "track", trajectory, {});
  write_cloud(run / "fuse", test::moved(room.wall(), away), default_labels(), PcdEncoding::binary);
  write_cloud(run / "voxel", test::moved(room.wall() + room.person(), away), default_labels(),
              PcdEncoding::binary);
  const std::string maps = quoted(room.folder.path()) + quoted(run / "fuse") + quoted(run / "voxel/");
  const auto outcome = evaluate(maps + "--json");
  REQUIRE(outcome.code == 0);
  const auto json = nlohmann::json::parse(outcome.output);
  REQUIRE(json["maps"].size() == 2);
  CHECK(json["maps"][0]["accuracy_m"]["mean"].get<double>() < 1e-5);
  CHECK(json["maps"][0]["cleaning"][0]["rr"] == 1.0);
  CHECK(json["maps"][1]["cleaning"][0]["pr"] == 1.0);
  CHECK(json["maps"][1]["cleaning"][0]["rr"] == 0.0);
  CHECK(json["maps"][1]["points_score"]["da"] == 0.0);
  CHECK(json["maps"][0]["label_miou"] == 1.0);
  const auto as_is = nlohmann::json::parse(evaluate(maps + "--json --as-is").output);
  CHECK(as_is["maps"][0]["accuracy_m"]["mean"].get<double>() > 1);
  CHECK_THAT(evaluate(maps).output,
             Contains("PR at 0.05 m") && Contains("label mIoU") && Contains("aligned by"));
}

TEST_CASE("a frozen cloud is a reference for geometry and labels") {
  const test::SmallRoom room;
  write_pcd(room.folder / "a.pcd", room.wall(), PcdEncoding::ascii);
  const auto json = nlohmann::json::parse(
      evaluate(quoted(room.folder / "truth" / "static_cloud") + quoted(room.folder / "a.pcd") + "--json")
          .output);
  CHECK(json["maps"][0]["f_score"] == 1.0);
  CHECK(json["maps"][0]["cleaning"][0]["rr"].is_null());
  CHECK_FALSE(json["maps"][0].contains("points_score"));
}

TEST_CASE("wrong calls of evaluate-map end with code 2, what is no map with 1") {
  const test::SmallRoom room;
  const std::string truth = quoted(room.folder.path());
  CHECK(evaluate("").code == 2);
  CHECK(evaluate("--help").code == 0);
  CHECK(evaluate(truth).code == 2);
  CHECK(evaluate(truth + truth + "--as-is --trajectory x").code == 2);
  CHECK(evaluate(truth + truth + "--min-height 2").code == 2);
  const auto no_map = evaluate(truth + quoted(room.folder / "rgb"));
  CHECK(no_map.code == 1);
  CHECK_THAT(no_map.output,
             Contains("rgb: no cloud (cloud.pcd, PCD, PLY), octree (map.ot) or grid (map.yaml)"));
  GridMap grid;
  grid.width = grid.height = 1;
  grid.cells = {Cell::free};
  write_grid_map(room.folder / "grid", grid);
  CHECK_THAT(evaluate(quoted(room.folder / "truth" / "static_cloud") + quoted(room.folder / "grid")).output,
             Contains("a grid needs the truth of a sequence"));
}
