#include "pipeline/runner/config/resources.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "pipeline/contract/errors.hpp"
#include "pipeline/contract/parameter.hpp"
#include "tests/pipeline/runner/workbench.hpp"

using Catch::Contains;
using sediment::contract::Json;
using sediment::contract::UsageError;
using sediment::test::Workbench;
using namespace sediment::runner;

TEST_CASE("amounts and times are read with their units") {
  CHECK(amount_from("memory", "4 GB") == 4'000'000'000);
  CHECK(amount_from("memory", "1.5GiB") == 1'610'612'736);
  CHECK(amount_from("memory", "700") == 700);
  CHECK(amount_from("gpus", "2") == 2);
  CHECK(seconds_from("90") == 90);
  CHECK(seconds_from("15m") == 900);
  CHECK(seconds_from("1.5 h") == 5400);
  for (const char* wrong : {"", "GB", "-1 GB", "4 QB", "4 GB!", "nan", "1e40"})
    CHECK_THROWS_AS(amount_from("memory", wrong), UsageError);
  for (const char* wrong : {"1.5", "2 GB", "-1"}) CHECK_THROWS_AS(amount_from("gpus", wrong), UsageError);
  CHECK_THROWS_AS(seconds_from("2 weeks"), UsageError);
}

TEST_CASE("what is taken is not free until it is given back") {
  FreeResources free({{"cpus", 4}, {"memory", 100}});
  const Amounts half{{"cpus", 2}, {"memory", 60}};
  REQUIRE(free.suffice(half));
  free.take(half);
  CHECK_FALSE(free.suffice(half));
  CHECK(free.suffice({{"cpus", 2}, {"memory", 40}}));
  CHECK_FALSE(free.suffice({{"gpus", 1}}));
  free.give_back(half);
  CHECK(free.suffice(half));
}

TEST_CASE("stages that together want more than there is run one after the other") {
  const Workbench bench;
  bench.write("pipeline.yaml", R"(sources: {sequence: {kind: sequence, path: data}}
stages:
  scan: {reads: {sequence: sequence}}
  smooth: {reads: {cloud: scan.cloud}, params: {sleep_s: 0.5}, resources: {licences: 1}}
  thin: {reads: {cloud: scan.cloud}, params: {sleep_s: 0.5}, resources: {licences: 1, memory: 1 MB, time: 1h}}
)");
  const auto none = bench.run();
  CHECK(none.code == 2);
  CHECK_THAT(
      none.err,
      Contains("stage smooth: wants 1 licences, this run has 0 licences (--resource licences=AMOUNT)"));
  // Lanes of the run's time line: no two stages of one lane ran at the same time.
  const auto lanes = [&](const std::string& flags) {
    bench.shell("rm -rf out");
    REQUIRE(bench.run("-j4 " + flags).code == 0);
    const Json trace = Json::parse(bench.shell("cat out/.sediment/runs/*/trace.json").out);
    std::set<int> all;
    for (const Json& event : trace.at("traceEvents")) all.insert(event.at("tid").get<int>());
    return all.size();
  };
  CHECK(lanes("--resource licences=1") == 1);
  CHECK(lanes("--resource licences=2") == 2);
}

TEST_CASE("a stage with retries is run again, with what it said before it failed") {
  const Workbench bench;
  bench.shell("sed -i 's/smooth: {/smooth: {retries: 2, resources: {memory: 1 MB}, /' pipeline.yaml");
  const std::string flags = "--set smooth.fault=twice --set smooth.diary=" + (bench / "diary").string();
  const auto run = bench.run(flags);
  CHECK(run.code == 0);
  CHECK(bench.started() == "smooth smooth smooth");
  CHECK_THAT(run.err, Contains("smooth: exited with 1; retry 2 of 2\n  | smooth: not yet"));
  const auto never = bench.run("--set smooth.fault=fail --set smooth.diary=" + (bench / "diary").string());
  CHECK(never.code == 1);
  CHECK(bench.started() == "smooth smooth smooth");
}

TEST_CASE("wrong resources are refused with their line") {
  const Workbench bench;
  bench.shell(
      "sed -i 's/thin: {/thin: {resources: {memory: 4 QB, time: soon}, retries: -1, /' pipeline.yaml");
  const auto run = bench.run();
  CHECK(run.code == 2);
  CHECK_THAT(run.err,
             Contains("pipeline.yaml:7: stage thin: memory: expected an amount like 4 GB, found \"4 QB\""));
  CHECK_THAT(run.err, Contains("time: expected a time like 90s, 15m, 2h or 1d, found \"soon\""));
  CHECK_THAT(run.err, Contains("expected a whole number for \"retries\""));
  CHECK(bench.run("--resource cpus").code == 2);
}
