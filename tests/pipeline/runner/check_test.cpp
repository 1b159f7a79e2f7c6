#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/pipeline/runner/workbench.hpp"

namespace fs = std::filesystem;
using Catch::Contains;
using sediment::test::Workbench;

TEST_CASE("all mistakes of a pipeline are reported at once, with file and line, before anything starts") {
  const Workbench bench;
  bench.write("pipeline.yaml", R"(sources:
  sequence: {kind: sequnce, path: "${SEQUENCE}"}
  extra: {kind: file, path: missing.txt}
  model: {kind: file, path: "${NOWHERE}"}
stages:
  scan: {reads: {sequence: sequence, modle: model}}
  smooth: {reads: {cloud: scan.clod}, params: {neighbours: 5, factor: 1.5}}
  thin: {reds: {cloud: smooth.cloud}}
  chart: {reads: {cloud: thin.cloud, second: model}, params: {neighbors: many, manner: rude}}
  charts: {reads: {cloud: thin.cloud}}
)");
  const auto run = bench.run("--set thin.factr=1 --set tin.factor=1 --set sequence2=x");
  CHECK(run.code == 2);
  for (const char* expected : {
           "pipeline.yaml:2: source sequence: unknown kind \"sequnce\" (did you mean \"sequence\"?)",
           "pipeline.yaml:3: source extra: ",
           "pipeline.yaml:4: source model: ${NOWHERE} is not set; set it in the environment or give --set "
           "model=PATH",
           "pipeline.yaml:6: stage scan: unknown role \"modle\" (did you mean \"model\"?)",
           "pipeline.yaml:7: stage smooth: cloud: nothing is called \"scan.clod\" (did you mean "
           "\"scan.cloud\"?)",
           "pipeline.yaml:7: stage smooth: unknown parameter \"neighbours\" (did you mean \"neighbors\"?)",
           "pipeline.yaml:7: stage smooth: factor: expected a number in 0.0 .. 1.0, found 1.5",
           "pipeline.yaml:8: stage thin: unknown key \"reds\" (did you mean \"reads\"?)",
           "pipeline.yaml:8: stage thin: reads nothing as \"cloud\"",
           "pipeline.yaml:9: stage chart: second: expected cloud, but model is file",
           "pipeline.yaml:9: stage chart: neighbors: expected a whole number in 1 .. 100, found \"many\"",
           "pipeline.yaml:9: stage chart: manner: expected one of plain, loud, found \"rude\"",
           "pipeline.yaml:10: unknown stage \"charts\": no such program in",
           "(did you mean \"chart\"?)",
           "--set thin.factr=1: unknown parameter \"factr\" (did you mean \"factor\"?)",
           "--set tin.factor=1: unknown stage \"tin\" (did you mean \"thin\"?)",
           "--set sequence2=x: unknown source \"sequence2\" (did you mean \"sequence\"?)",
       })
    CHECK_THAT(run.err, Contains(expected));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a cycle is named") {
  const Workbench bench;
  bench.write("pipeline.yaml", R"(stages:
  smooth: {reads: {cloud: thin.cloud}}
  thin: {reads: {cloud: smooth.cloud}}
)");
  const auto run = bench.run();
  CHECK(run.code == 2);
  CHECK_THAT(run.err, Contains("the stages form a cycle: smooth -> thin -> smooth") ||
                          Contains("the stages form a cycle: thin -> smooth -> thin"));
}

TEST_CASE("stages may stand in any order in the file") {
  const Workbench bench;
  bench.write("pipeline.yaml", R"(stages:
  thin: {reads: {cloud: smooth.cloud}}
  smooth: {reads: {cloud: scan.cloud}}
  scan: {reads: {sequence: sequence}}
sources: {sequence: {kind: sequence, path: data}}
)");
  CHECK(bench.run().code == 0);
}

TEST_CASE("repeated keys, broken YAML and files that are not there are refused") {
  const Workbench bench;
  bench.write("pipeline.yaml", "stages:\n  scan: {reads: {}}\n  scan: {reads: {}}\n");
  CHECK_THAT(bench.run().err, Contains("pipeline.yaml:3: stages: \"scan\" is there twice"));
  bench.write("pipeline.yaml", "stages:\n  scan: {reads: [}\n");
  const auto broken = bench.run();
  CHECK(broken.code == 2);
  CHECK_THAT(broken.err, Contains("pipeline.yaml:2: "));
  bench.write("pipeline.yaml", "");
  CHECK_THAT(bench.run().err, Contains("has no stages"));
  CHECK(bench.sediment("run nothing.yaml").code == 2);
}

TEST_CASE("a value is read in the type of its parameter, unset equals the default") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  REQUIRE(
      bench.run(bench.noted() + "--set scan.neighbors=50 --set thin.factor=0.250 --set smooth.words=").code ==
      0);
  CHECK(bench.started().empty());
  REQUIRE(bench.run(bench.noted() + "--set scan.words=a,b").code == 0);
  CHECK(bench.started() == "scan");
}

TEST_CASE("sources are given by variables, by --set and by path; a sequence may be a folder") {
  const Workbench bench;
  const auto unset = bench.shell("exec '" SEDIMENT_BINARY_DIR "/sediment' run pipeline.yaml --stages stages");
  CHECK(unset.code == 2);
  CHECK_THAT(unset.err, Contains("${SEQUENCE} is not set"));
  CHECK(bench.run("--set sequence=data/sequence.yaml").code == 0);
  CHECK_THAT(bench.run().out, Contains("4 kept"));
  const auto bare = bench.run("--set sequence=data/rgb");
  CHECK(bare.code == 2);
  CHECK_THAT(bare.err, Contains("data/rgb is a folder without a sequence.yaml"));
}

TEST_CASE("wrong calls exit with 2 and name the nearest command") {
  const Workbench bench;
  CHECK_THAT(bench.sediment("rnu x").err, Contains("unknown command \"rnu\" (did you mean \"run\"?)"));
  CHECK(bench.sediment("run").code == 2);
  CHECK(bench.run("--frm x").code == 2);
  CHECK(bench.run("--set sor").code == 2);
  CHECK(bench.sediment("--help").code == 0);
  CHECK_THAT(bench.sediment("run --help").out, Contains("--keep-going"));
}
