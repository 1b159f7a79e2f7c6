#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/pipeline/runner/workbench.hpp"

namespace fs = std::filesystem;
using Catch::Contains;
using sediment::test::Workbench;

TEST_CASE("plan shows what would run, why and with which call, and touches nothing") {
  const Workbench bench;
  const auto plan = bench.call("plan", bench.noted());
  CHECK(plan.code == 0);
  CHECK_THAT(plan.out, Contains("scan: runs (first run)"));
  CHECK_THAT(plan.out, Contains("/stages/scan --sequence " + (bench / "data/sequence.yaml").string()));
  CHECK_THAT(plan.out, Contains("thin: may run (behind smooth)"));
  CHECK_THAT(plan.out, Contains("--factor=0.25"));
  CHECK_THAT(plan.out, Contains("0 kept, 1 to run, 3 behind them"));
  CHECK(bench.started().empty());
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("why names every part that differs") {
  const Workbench bench;
  CHECK_THAT(bench.call("why", "smooth").out, Contains("smooth: may run (behind scan)"));
  REQUIRE(bench.run().code == 0);
  CHECK(bench.call("why", "thin").out == "thin: kept; it last ran for: first run\n");
  const auto why = bench.call("why", "thin --set thin.neighbors=30 --set thin.manner=loud");
  CHECK(why.out ==
        "thin: runs (manner: plain -> loud, and 1 more)\n  params/manner: plain -> loud\n"
        "  params/neighbors: 50 -> 30\n");
  CHECK_THAT(bench.call("why", "--set thin.neighbors=30").out, Contains("scan: kept"));
  bench.shell("echo x >>data/rgb/1.png");
  CHECK_THAT(bench.call("why", "scan").out, Contains("inputs/sequence: x3:"));
  CHECK(bench.call("why", "tin").code == 2);
  CHECK(bench.sediment("why thin pipeline.yaml --out out --stages stages").code == 0);
}

TEST_CASE("why remembers for what a stage last ran") {
  const Workbench bench;
  REQUIRE(bench.run().code == 0);
  REQUIRE(bench.run("--set thin.neighbors=30").code == 0);
  REQUIRE(bench.run("--set thin.neighbors=30").code == 0);
  CHECK(bench.call("why", "thin --set thin.neighbors=30").out ==
        "thin: kept; it last ran for: neighbors: 50 -> 30\n");
}

TEST_CASE("status tells what is there, what is not and what failed") {
  const Workbench bench;
  REQUIRE(bench.run("--set thin.fault=fail").code == 1);
  const auto status = bench.call("status", "--set thin.fault=fail");
  CHECK(status.code == 0);
  CHECK_THAT(status.out, Contains("smooth  up to date"));
  CHECK_THAT(status.out, Contains("thin    failed"));
  CHECK_THAT(status.out, Contains("chart   may run"));
}

TEST_CASE("graph draws the pipeline as text, Mermaid and DOT") {
  const Workbench bench;
  CHECK_THAT(bench.call("graph").out, Contains("chart\n  cloud <- thin\n  second <- smooth\n"));
  CHECK_THAT(bench.call("graph", "--format mermaid").out, Contains("flowchart LR\n  sequence([sequence])"));
  CHECK_THAT(bench.call("graph", "--format mermaid").out, Contains("smooth -- second --> chart"));
  CHECK_THAT(bench.call("graph", "--format dot").out, Contains("\"thin\" -> \"chart\" [label=\"cloud\"];"));
  CHECK(bench.call("graph", "--format xml").code == 2);
}
