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
  REQUIRE(bench.run("--set smooth.fault=orphan").code == 0);
  CHECK_FALSE(runs_anywhere(bench));
  bench.shell("sleep 0.2");
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
  CHECK(fs::is_empty(bench / "store/locks"));
}
