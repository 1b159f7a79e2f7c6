// log, accept, pin, prune and seal: what becomes of results later.
#include <catch2/catch.hpp>
#include <filesystem>

#include "pipeline/contract/parameter.hpp"
#include "tests/pipeline/runner/workbench.hpp"

namespace fs = std::filesystem;
using Catch::Contains;
using sediment::contract::Json;
using sediment::test::Workbench;

TEST_CASE("log prints the call, the cost and the words of a result, or of the last failure") {
  const Workbench bench;
  REQUIRE(bench.run("--set thin.neighbors=20").code == 0);
  const auto log = bench.call("log", "thin --set thin.neighbors=20");
  CHECK(log.code == 0);
  CHECK_THAT(log.out, Contains("/stages/thin --cloud") && Contains("--neighbors=20") &&
                          Contains("because: first run"));
  REQUIRE(bench.run("--set thin.fault=fail").code == 1);
  CHECK_THAT(bench.call("log", "thin").out, Contains("failed: exited with 1\nthin: frame 7: asked to fail"));
  CHECK(bench.call("log", "thim").code == 2);
  CHECK(bench.call("log").code == 2);
}

TEST_CASE("accept takes the last result for right after a change, and says so in the receipt") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  CHECK(bench.call("accept", "thin" + bench.noted()).code == 2);
  bench.shell(
      "cp --remove-destination $(readlink -f stages/smooth) stages/smooth && printf x >>stages/smooth");
  CHECK_THAT(bench.call("accept", "thin" + bench.noted()).err,
             Contains("behind smooth: accept or run that first"));
  const auto accepted = bench.call("accept", "smooth " + bench.noted());
  CHECK(accepted.code == 0);
  CHECK_THAT(accepted.out, Contains("exe: x3:"));
  CHECK_THAT(bench.run(bench.noted()).out, Contains("4 kept"));
  CHECK(bench.started().empty());
  CHECK_THAT(bench.call("log", "smooth " + bench.noted()).out, Contains("accepted: {\"by\""));
  CHECK(bench.sediment("verify --out out").code == 0);
}

TEST_CASE("prune removes what the rules name, but never what is linked or pinned") {
  const Workbench bench;
  REQUIRE(bench.run("--set scan.neighbors=10").code == 0);
  REQUIRE(bench.call("pin", "scan --set scan.neighbors=10").code == 0);
  REQUIRE(bench.run("--set scan.neighbors=20").code == 0);
  REQUIRE(bench.run().code == 0);
  CHECK(bench.call("prune").code == 2);
  CHECK(bench.call("prune", "--older-than 1h").out == "0 results were removed, 0 B\n");

  const auto planned = bench.call("prune", "--max-size 0 --dry-run");
  CHECK_THAT(planned.out, Contains("7 results would be removed"));
  CHECK_THAT(bench.run("--set scan.neighbors=20").out, Contains("4 kept"));
  REQUIRE(bench.run().code == 0);
  CHECK_THAT(bench.call("prune", "--max-size 0").out, Contains("7 results were removed"));
  CHECK_THAT(bench.run().out, Contains("4 kept"));
  CHECK_THAT(bench.run("--set scan.neighbors=10").out, Contains("1 kept, 3 ran"));
  CHECK(bench.sediment("verify --out out").code == 0);

  REQUIRE(bench.call("pin", "scan --remove --set scan.neighbors=10").code == 0);
  REQUIRE(bench.run().code == 0);
  CHECK_THAT(bench.call("prune", "--older-than 0s").out, Contains("4 results were removed"));
}

TEST_CASE("prune --keep leaves what the pipelines would use now, wherever its links are") {
  const Workbench bench;
  REQUIRE(bench.run().code == 0);
  REQUIRE(bench.run("--set thin.neighbors=20").code == 0);
  bench.shell("mv out/.sediment store && rm -r out");
  CHECK_THAT(bench.sediment("prune --keep pipeline.yaml --store store --stages stages").out,
             Contains("thin") && Contains("2 results were removed"));
  CHECK_THAT(bench.run("--store store").out, Contains("4 kept"));
}

TEST_CASE("a sealed dataset keeps its id, and a run looks at nothing of it but its manifest") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  CHECK_THAT(bench.sediment("seal data").out, Contains("6 files"));
  CHECK_FALSE(fs::status(bench / "data/rgb/1.png").permissions() == fs::perms::owner_all);
  CHECK_THAT(bench.run(bench.noted()).out, Contains("4 kept"));
  CHECK_THAT(bench.run(bench.noted()).out, Contains("4 kept"));
  // Another content without another manifest is what the seal promises not to happen: nobody looks.
  bench.shell("chmod u+w data/rgb/1.png; echo changed >data/rgb/1.png");
  CHECK_THAT(bench.run(bench.noted()).out, Contains("4 kept"));
  CHECK(bench.started().empty());
  bench.sediment("seal data");
  REQUIRE(bench.run(bench.noted()).code == 0);
  CHECK_THAT(bench.started(), Catch::StartsWith("scan"));
  CHECK(bench.sediment("seal data --remove").code == 0);
  CHECK(bench.run(bench.noted()).code == 0);
  CHECK(bench.started().empty());
  CHECK(bench.sediment("seal data --remove").code == 2);
  CHECK_THAT(bench.sediment("seal out/thin").err, Contains("is a result of the stage thin"));
}

TEST_CASE("plan, why, status and graph answer in JSON") {
  const Workbench bench;
  REQUIRE(bench.run("--until smooth").code == 0);
  const Json plan = Json::parse(bench.call("plan", "--json --set smooth.neighbors=7").out);
  REQUIRE(plan.size() == 4);
  CHECK(plan[0]["state"] == "kept");
  CHECK(plan[1]["state"] == "runs");
  CHECK(plan[1]["differences"][0] == Json({{"part", "params/neighbors"}, {"before", "50"}, {"after", "7"}}));
  CHECK(plan[1]["parts"]["params"]["neighbors"] == 7);
  CHECK(plan[2]["state"] == "may run");
  CHECK(Json::parse(bench.call("why", "smooth --json").out)["state"] == "kept");
  CHECK(Json::parse(bench.call("status", "--json").out)[0]["state"] == "up to date");
  CHECK(Json::parse(bench.call("graph", "--json").out)["stages"][3]["reads"] ==
        Json({{"cloud", "thin"}, {"second", "smooth"}}));
}

TEST_CASE("with fingerprint: version a program that was only linked again keeps its results") {
  const Workbench bench;
  bench.write("pipeline.yaml", std::string("fingerprint: version\n") + sediment::test::kPipeline);
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  bench.shell(
      "cp --remove-destination $(readlink -f stages/smooth) stages/smooth && printf x >>stages/smooth");
  CHECK_THAT(bench.run(bench.noted()).out, Contains("4 kept"));
  CHECK(bench.started().empty());
  bench.write("pipeline.yaml", sediment::test::kPipeline);
  CHECK_THAT(bench.call("why", "scan " + bench.noted()).out, Contains("exe: version "));
  bench.write("pipeline.yaml", std::string("fingerprint: name\n") + sediment::test::kPipeline);
  CHECK_THAT(bench.run().err,
             Contains("pipeline.yaml:1: fingerprint: expected content or version, found \"name\""));
}
