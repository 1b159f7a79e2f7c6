#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "pipeline/artifacts/file_bytes.hpp"
#include "pipeline/artifacts/image_file.hpp"
#include "pipeline/artifacts/trajectory_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace sediment;
using Catch::Matchers::Contains;

namespace {

/// A folder with groundtruth.txt, rgb.txt of 50 frames and track/ of which the last 10 frames are lost.
struct Bench {
  Bench() {
    Trajectory truth;
    std::vector<FrameTracking> frames;
    std::string list;
    for (int i = 0; i < 50; ++i) {
      const double stamp_s = 100 + 0.05 * i;
      truth.push_back(
          {std::to_string(stamp_s), stamp_s, pose_from({}, {0.1 * i, std::sin(0.3 * i), std::cos(0.5 * i)})});
      frames.push_back(
          {truth.back().stamp, i < 40 ? TrackingState::tracked : TrackingState::lost, false, 0, 0, 0});
      list += truth.back().stamp + " rgb/x.png\n";
    }
    write_tum_trajectory(folder / "groundtruth.txt", truth);
    truth.resize(40);
    write_trajectory(folder / "track", truth, frames);
    write_bytes(folder / "rgb.txt", {list});
  }
  std::string path(const char* name) const { return "'" + (folder / name).string() + "' "; }
  test::Outcome run(const std::string& arguments) const {
    return test::run_program("evaluate-trajectory", arguments);
  }

  test::TemporaryFolder folder;
};

}  // namespace

TEST_CASE("a trajectory folder is evaluated with the coverage its tracking.json tells") {
  const Bench bench;
  const auto outcome = bench.run(bench.path("groundtruth.txt") + bench.path("track") + "--json");
  REQUIRE(outcome.code == 0);
  const auto json = nlohmann::json::parse(outcome.output);
  CHECK(json["ate"]["rmse"].get<double>() < 1e-6);
  CHECK(json["ate"]["pairs"] == 40);
  CHECK(json["pairs"] == 40);
  CHECK(json["coverage"] == 0.8);
  CHECK(json["rpe"]["translation"]["rmse"].get<double>() < 1e-6);
  CHECK(json["rpe"]["rotation_deg"]["rmse"].get<double>() < 1e-3);
  CHECK(json["rpe"]["pairs"] == 19);
  CHECK(json["evo"]["ape_aligned"]["translation"]["rmse"].get<double>() < 1e-6);
}

TEST_CASE("the number of frames comes from where it is said, and is said to be unknown otherwise") {
  const Bench bench;
  std::filesystem::remove(bench.folder / "track" / "tracking.json");
  const std::string both = bench.path("groundtruth.txt") + bench.path("track/trajectory.txt");
  CHECK_THAT(bench.run(both).output, Contains("coverage 0.8000: 40 of 50 frames (rgb.txt)"));
  CHECK_THAT(bench.run(both + "--sequence-frames 80").output, Contains("coverage 0.5000: 40 of 80 frames"));
  std::filesystem::rename(bench.folder / "rgb.txt", bench.folder / "list.txt");
  CHECK_THAT(bench.run(both + "--frames " + bench.path("list.txt")).output,
             Contains("40 of 50 frames (list.txt)"));
  CHECK_THAT(bench.run(both).output, Contains("coverage unknown"));
  CHECK(nlohmann::json::parse(bench.run(both + "--json").output)["coverage"].is_null());
}

TEST_CASE("picture, table and evo's archives are written, twice with the same bytes") {
  const Bench bench;
  const std::string both = bench.path("groundtruth.txt") + bench.path("track");
  const auto write = [&](const char* to) {
    const std::string at = (bench.folder / to).string();
    return bench
        .run(both + "--plot " + at + "/p.png --csv " + at + "/p.csv --evo-ape " + at + "/ape.zip --evo-rpe " +
             at + "/rpe.zip")
        .code;
  };
  REQUIRE(write("a") == 0);
  REQUIRE(write("b") == 0);
  for (const char* name : {"p.png", "p.csv", "ape.zip", "rpe.zip"})
    CHECK(read_bytes(bench.folder / "a" / name) == read_bytes(bench.folder / "b" / name));
  CHECK(probe_image(bench.folder / "a" / "p.png").width > 600);
  const std::string csv = read_bytes(bench.folder / "a" / "p.csv");
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 41);
}

TEST_CASE("wrong input is answered by a message and never by a number") {
  const Bench bench;
  const auto [text, expected] = GENERATE(table<std::string, std::string>(
      {{"", "holds no pose"},
       {"# nothing\n", "holds no pose"},
       {"900 0 0 0 0 0 0 1\n901 0 0 0 0 0 0 1\n902 0 0 0 0 0 0 1\n", "same sequence?"},
       {"100 0 0 0 0 0 0 1\n100.05 0 0 0 0 0 0 1\n", "at least 3 are needed"},
       {"100 0 0 0 0 0 0 1\n100 0 0 0 0 0 0 1\n", "estimate.txt:2: stamp 100 is given twice"},
       {"100 0 0 nan 0 0 0 1\n", "estimate.txt:1: expected a number for tz, found \"nan\""},
       {"100 0 0 0 0 0 1\n", "estimate.txt:1: expected 8 columns"}}));
  write_bytes(bench.folder / "estimate.txt", {text});
  for (const char* flag : {"", "--json"}) {
    const auto outcome = bench.run(bench.path("groundtruth.txt") + bench.path("estimate.txt") + flag);
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.output, Contains(expected) && !Contains("rmse"));
  }
}

TEST_CASE("a wrong call ends with code 2, help with 0, a missing file with 1") {
  const Bench bench;
  CHECK(bench.run("").code == 2);
  CHECK(bench.run("a b --tolerance 3").code == 2);
  CHECK(bench.run("a b --frames x --sequence-frames 3").code == 2);
  CHECK(bench.run("--help").code == 0);
  const auto outcome = bench.run(bench.path("groundtruth.txt") + bench.path("none.txt"));
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.output, Contains("none.txt: No such file"));
}
