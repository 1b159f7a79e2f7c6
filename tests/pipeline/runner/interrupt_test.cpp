#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>

#include "tests/pipeline/runner/workbench.hpp"

namespace fs = std::filesystem;
using Catch::Contains;
using sediment::test::Workbench;

namespace {

/// Starts a run in the background, waits until `stage` was started, sends the signal and returns the exit
/// code.
std::string interrupted(const Workbench& bench, const std::string& flags, const std::string& stage,
                        const std::string& signal) {
  const std::string command =
      "SEQUENCE=data '" SEDIMENT_BINARY_DIR "/sediment' run pipeline.yaml --out out --stages stages " +
      flags + " >run.out 2>run.err & pid=$!; for i in $(seq 200); do grep -qs " + stage +
      " diary && break; sleep 0.05; done; sleep 0.2; kill -" + signal + " $pid; wait $pid; echo $?";
  return bench.shell(command).out;
}

bool runs_anywhere(const Workbench& bench) {
  // The brackets keep the pattern from matching the command line of this very search.
  return bench.shell("pgrep -f '" + (bench / "out").string() + "/[.]sediment'").code == 0;
}

}  // namespace

TEST_CASE("^C and SIGTERM end the stages, exit with 130 and leave nothing half") {
  const Workbench bench;
  const auto signal = GENERATE(as<std::string>{}, "INT", "TERM");
  CHECK(interrupted(bench, bench.noted() + "--set smooth.fault=hang", "smooth", signal) == "130\n");
  CHECK_FALSE(runs_anywhere(bench));
  CHECK(fs::exists(bench / "out/scan"));
  CHECK_FALSE(fs::exists(bench / "out/smooth"));
  CHECK(fs::is_empty(bench / "out/.sediment/attempts"));
  CHECK_THAT(bench.read("run.out"), Contains("smooth  interrupted"));
  CHECK(bench.run().code == 0);
}

TEST_CASE("a stage dies with its runner, and the next run needs no hand work") {
  const Workbench bench;
  CHECK(interrupted(bench, bench.noted() + "--set smooth.sleep_s=30", "smooth", "KILL") == "137\n");
  CHECK_FALSE(runs_anywhere(bench));
  CHECK_FALSE(fs::exists(bench / "out/smooth"));
  bench.started();
  REQUIRE(bench.run(bench.noted()).code == 0);
  CHECK(bench.started() == "smooth thin chart");
  CHECK(fs::is_empty(bench / "out/.sediment/attempts"));
}

TEST_CASE("what a stage leaves running cannot touch its result") {
  const Workbench bench;
  const auto fault = GENERATE(as<std::string>{}, "orphan", "daemon");
  REQUIRE(bench.run("--set smooth.fault=" + fault).code == 0);
  CHECK_FALSE(runs_anywhere(bench));
  bench.shell("sleep 1");
  CHECK_THAT(bench.read("out/smooth/text.txt"), !Contains("late"));
}

TEST_CASE("two and four runners on one store go on, and each result is made once") {
  const Workbench bench;
  const int runners = GENERATE(2, 4);
  std::string command, waits;
  for (int i = 0; i < runners; ++i) {
    command += "SEQUENCE=data '" SEDIMENT_BINARY_DIR
               "/sediment' run pipeline.yaml --stages stages --store store -j2 --set scan.sleep_s=0.3 " +
               bench.noted() + "--out out" + std::to_string(i) + " & p" + std::to_string(i) + "=$!; ";
    waits += "wait $p" + std::to_string(i) + " || exit 1; ";
  }
  CHECK(bench.shell(command + waits).code == 0);
  CHECK(bench.started() == "scan smooth thin chart");
  for (int i = 1; i < runners; ++i)
    CHECK(bench.read("out0/chart/manifest.json") ==
          bench.read("out" + std::to_string(i) + "/chart/manifest.json"));
  CHECK(fs::is_empty(bench / "store/attempts"));
}

TEST_CASE(
    "four runners on one sweep share its work: each key is made once, and every runner has every result") {
  const Workbench bench;
  bench.write("all.yaml",
              "pipeline: pipeline.yaml\nover: [{smooth.neighbors: [10, 20, 30, 40]}, {thin.factor: [0.1, "
              "0.2, 0.3]}]\n");
  std::string command, waits;
  for (const char* out : {"out0", "out1", "out2", "out3"}) {
    command +=
        std::string("SEQUENCE=data '" SEDIMENT_BINARY_DIR "/sediment' sweep all.yaml --stages stages ") +
        "--store store -j2 --set scan.sleep_s=0.1 --set smooth.sleep_s=0.1 " + bench.noted() + "--out " +
        out + " >" + out + ".log 2>&1 & p" + out + "=$!; ";
    waits += std::string("wait $p") + out + " || exit 1; ";
  }
  REQUIRE(bench.shell(command + waits).code == 0);
  const std::string started = bench.started() + ' ';
  const auto count = [&](const std::string& stage) {
    std::size_t found = 0;
    for (std::size_t at = started.find(stage); at != started.npos; at = started.find(stage, at + 1)) ++found;
    return found;
  };
  CHECK(count("scan ") == 1);
  CHECK(count("smooth ") == 4);
  CHECK(count("thin ") == 12);
  CHECK(count("chart ") == 12);
  for (const char* out : {"out1", "out2", "out3"})
    CHECK(bench.shell(std::string("diff -r --exclude=run.json out0 ") + out).code == 0);
  CHECK(bench.sediment("verify --store store").code == 0);
  CHECK(fs::is_empty(bench / "store/attempts"));
}
