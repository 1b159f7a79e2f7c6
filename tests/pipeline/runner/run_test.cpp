#include <catch2/catch.hpp>
#include <filesystem>

#include "pipeline/contract/manifest.hpp"
#include "tests/pipeline/runner/workbench.hpp"

namespace fs = std::filesystem;
using Catch::Contains;
using sediment::test::Workbench;

TEST_CASE("a run leaves the result of every stage, a second one starts nothing") {
  const Workbench bench;
  const auto first = bench.run(bench.noted());
  REQUIRE(first.code == 0);
  CHECK(bench.started() == "scan smooth thin chart");
  CHECK_THAT(first.out, Contains("4 ran"));
  CHECK(bench.read("out/chart/text.txt") ==
        "root: .\ncamera: {width: 4}\nscan 50 0.5\nsmooth 50 0.5\nthin 50 0.25\n"
        "root: .\ncamera: {width: 4}\nscan 50 0.5\nsmooth 50 0.5\nchart 50 0.5\n");
  for (const char* stage : {"scan", "smooth", "thin", "chart"})
    CHECK(sediment::contract::read_manifest(bench / "out" / stage).stage == stage);

  const auto second = bench.run(bench.noted());
  CHECK(second.code == 0);
  CHECK(bench.started().empty());
  CHECK_THAT(second.out, Contains("4 kept"));
}

TEST_CASE("neither touch nor another place of the same sources starts anything") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  bench.shell("find data -exec touch {} +");
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.shell("mkdir elsewhere && mv data elsewhere/moved");
  REQUIRE(bench.run(bench.noted() + "--set sequence=elsewhere/moved").code == 0);
  CHECK(bench.started().empty());
}

TEST_CASE("a changed parameter reruns its stage and those behind it and nothing else") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  const auto run = bench.run(bench.noted() + "--set thin.neighbors=30");
  CHECK(run.code == 0);
  CHECK(bench.started() == "thin chart");
  CHECK_THAT(run.out, Contains("neighbors: 50 -> 30"));
  CHECK_THAT(run.out, Contains("2 kept, 2 ran"));
  // Both variants are in the store: going back costs nothing.
  REQUIRE(bench.run(bench.noted()).code == 0);
  CHECK(bench.started().empty());
  CHECK_THAT(bench.read("out/thin/text.txt"), Contains("thin 50"));
}

TEST_CASE("a rerun that gives the same bytes stops the wave behind it") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  REQUIRE(bench.run(bench.noted() + "--set scan.neighbors=51").code == 0);
  CHECK(bench.started() == "scan");
}

TEST_CASE("a changed image, list or camera of a sequence is noticed") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  const auto change = GENERATE(as<std::string>{}, "echo x >>data/rgb/2.png", "echo x >data/depth/1.png",
                               "echo '3.0 rgb/1.png' >>data/rgb.txt", "sed -i s/4/5/ data/sequence.yaml",
                               "rm data/rgb/1.png");
  bench.shell(change);
  const auto run = bench.run(bench.noted());
  REQUIRE(run.code == 0);
  INFO(change);
  CHECK_THAT(bench.started(), Catch::StartsWith("scan"));
  CHECK_THAT(run.out, Contains("sequence changed"));
}

TEST_CASE("a changed program reruns its stage") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  bench.shell("cp --remove-destination $(readlink -f stages/thin) stages/thin && printf x >>stages/thin");
  const auto run = bench.run(bench.noted());
  REQUIRE(run.code == 0);
  CHECK(bench.started() == "thin");
  CHECK_THAT(run.out, Contains("the program changed"));
}

TEST_CASE("a failed stage publishes nothing, blocks those behind it and shows what it said") {
  const Workbench bench;
  const auto fault = GENERATE(as<std::string>{}, "fail", "crash", "lie", "link");
  const auto run = bench.run(bench.noted() + "--set smooth.fault=" + fault);
  CHECK(run.code == 1);
  CHECK(bench.started() == "scan smooth");
  CHECK_THAT(run.err, Contains("smooth: FAILED"));
  if (fault == "fail") CHECK_THAT(run.err, Contains("| smooth: frame 7: asked to fail"));
  if (fault == "crash") CHECK_THAT(run.err, Contains("killed by signal 6"));
  if (fault == "lie") CHECK_THAT(run.err, Contains("its manifest.json does not match its files"));
  if (fault == "link") CHECK_THAT(run.err, Contains("link"));
  CHECK_THAT(run.out, Contains("behind smooth"));
  CHECK_FALSE(fs::exists(bench / "out/smooth"));
  CHECK(fs::is_empty(bench / "out/.sediment/attempts"));
  CHECK(bench.run(bench.noted()).code == 0);
}

TEST_CASE("flag --keep-going makes what does not depend on the failure") {
  const Workbench bench;
  bench.write("pipeline.yaml", R"(sources: {sequence: {kind: sequence, path: data}}
stages:
  scan: {reads: {sequence: sequence}}
  smooth: {reads: {cloud: scan.cloud}, params: {fault: fail}}
  thin: {reads: {cloud: scan.cloud}}
  chart: {reads: {cloud: thin.cloud}}
)");
  const auto stopped = bench.run("-j1");
  CHECK(stopped.code == 1);
  CHECK_FALSE(fs::exists(bench / "out/chart"));
  const auto kept_going = bench.run("-j1 --keep-going");
  CHECK(kept_going.code == 1);
  CHECK(fs::exists(bench / "out/chart"));
}

TEST_CASE("flag --only, --from and --until limit what runs") {
  const Workbench bench;
  REQUIRE(bench.run(bench.noted() + "--until smooth").code == 0);
  CHECK(bench.started() == "scan smooth");
  const auto missing = bench.run(bench.noted() + "--only chart");
  CHECK(missing.code == 1);
  CHECK_THAT(missing.err, Contains("thin: FAILED: is needed, is not in the store (first run)"));
  CHECK(bench.started().empty());
  REQUIRE(bench.run(bench.noted() + "--only thin").code == 0);
  CHECK(bench.started() == "thin");
  REQUIRE(bench.run(bench.noted() + "--from smooth --set smooth.neighbors=20").code == 0);
  CHECK(bench.started() == "smooth thin chart");
  CHECK(bench.run("--only smoth").code == 2);
}

TEST_CASE("an optional source is read only if it is given") {
  const Workbench bench;
  bench.write("net.onnx", "net ");
  REQUIRE(bench.run(bench.noted()).code == 0);
  bench.started();
  const auto run = bench.run(bench.noted() + "--until scan --set model=net.onnx");
  CHECK(bench.started() == "scan");
  CHECK_THAT(run.out, Contains("model changed"));
  CHECK_THAT(bench.read("out/scan/text.txt"), Contains("net scan"));
}

TEST_CASE("a script that describes itself and seals its result is a stage") {
  const Workbench bench;
  bench.shell("stages/thin --describe | sed s/thin/script/ >script.json; rm stages/thin");
  bench.write("stages/script", "#!/bin/sh\n[ \"$1\" = --describe ] && exec cat '" +
                                   (bench / "script.json").string() +
                                   "'\nexec -a script '" SEDIMENT_BINARY_DIR "/fake_stage' \"$@\"\n");
  bench.shell(
      "sed -i s/exec/exec/ stages/script; sed -i 1s/sh/bash/ stages/script; chmod +x stages/script; "
      "sed -i s/thin/script/g pipeline.yaml");
  const auto run = bench.run();
  INFO(run.err);
  CHECK(run.code == 0);
  CHECK_THAT(bench.read("out/script/text.txt"), Contains("script 50 0.25"));
}

TEST_CASE("a folder of the user's in the place of a link is never replaced") {
  const Workbench bench;
  bench.write("out/thin/thesis.txt", "years");
  const auto run = bench.run();
  CHECK(run.code == 2);
  CHECK_THAT(run.err, Contains("out/thin is no link of an earlier run"));
  CHECK(bench.read("out/thin/thesis.txt") == "years");
  CHECK_FALSE(fs::exists(bench / "out/scan"));
}
