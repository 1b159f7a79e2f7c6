#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "pipeline/contract/errors.hpp"
#include "pipeline/contract/parameter.hpp"
#include "pipeline/runner/sweep/result_table.hpp"
#include "pipeline/runner/sweep/sweep_points.hpp"
#include "tests/pipeline/runner/workbench.hpp"

namespace fs = std::filesystem;
using Catch::Contains;
using sediment::contract::Json;
using sediment::contract::UsageError;
using sediment::test::Workbench;
using namespace sediment::runner;

namespace {

constexpr const char* kSweep = R"(pipeline: pipeline.yaml
over:
  - sequence: [data, more, data/../third]
  - smooth.neighbors: {from: 10, to: 30, step: 10}
  - {thin.factor: [0.25, 0.5], thin.manner: [plain, loud]}
set: {scan.neighbors: 40}
)";

/// A workbench with three sequences and a sweep of 3 x 3 x 2 instances over them.
struct SweepBench : Workbench {
  SweepBench() {
    shell(
        "sed -i 's/root: ./root: .  # /' data/sequence.yaml; cp -r data more; cp -r data third; "
        "echo more >more/rgb/1.png; echo third >third/rgb/1.png; sed -i 's/width: 4/width: 5/' "
        "more/sequence.yaml; "
        "sed -i 's/width: 4/width: 6/' third/sequence.yaml; find . -exec touch -h -d '1 hour ago' {} +");
    write("all.yaml", kSweep);
  }
  auto sweep(const std::string& flags = "") const {
    return sediment("sweep all.yaml --stages stages " + flags);
  }
};

SweepFile sweep_from(const Workbench& bench, const std::string& text) {
  bench.write("sweep.yaml", text);
  Violations violations(bench / "sweep.yaml");
  SweepFile sweep = read_sweep(bench / "sweep.yaml", violations);
  violations.throw_if_any();
  return sweep;
}

}  // namespace

TEST_CASE("a sweep has every combination of its axes, and each has a name of its own") {
  const SweepBench bench;
  const auto points = points_of(sweep_from(bench, kSweep));
  REQUIRE(points.size() == 18);
  CHECK(points[0].name == "data/smooth.neighbors=10,thin.factor=0.25,thin.manner=plain");
  CHECK(points[1].name == "data/smooth.neighbors=10,thin.factor=0.5,thin.manner=loud");
  CHECK(points[17].name == "third/smooth.neighbors=30,thin.factor=0.5,thin.manner=loud");
  const auto twins = points_of(sweep_from(bench, "pipeline: p\nover: [{sequence: [a/x.yaml, b/x.yaml]}]\n"));
  CHECK(twins[0].name == "x");
  CHECK(twins[1].name == "x~2");
}

TEST_CASE("ranges have no rounding in them, patterns find files") {
  const Workbench bench;
  const auto range = sweep_from(bench, "pipeline: p\nover: [{a.b: {from: 0.1, to: 0.5, step: 0.1}}]\n");
  CHECK(range.axes[0].points ==
        std::vector<std::vector<std::string>>{{"0.1"}, {"0.2"}, {"0.3"}, {"0.4"}, {"0.5"}});
  const auto files = sweep_from(bench, "pipeline: p\nover: [{picture: \"data/rgb/*.png\"}]\n");
  REQUIRE(files.axes[0].points.size() == 2);
  CHECK(files.axes[0].points[1][0] == (bench / "data/rgb/2.png").string());
}

TEST_CASE("mistakes of a sweep are reported with their lines") {
  const Workbench bench;
  const auto said = [&](const std::string& text) -> std::string {
    try {
      sweep_from(bench, text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(said("pipeline: p\nover:\n  - {a.b: [1, 2], a.c: [1]}\n"),
             Contains("sweep.yaml:3: a.c has 1 values, but a.b, which walks with it, has 2"));
  CHECK_THAT(said("pipeline: p\nover: [{a.b: {from: 2, to: 1, step: 1}}]\n"),
             Contains("with A <= B and S > 0"));
  CHECK_THAT(said("pipeline: p\nover: [{a.b: 3}]\n"), Contains("expected a list, a range"));
  CHECK_THAT(said("pipeline: p\nover: [{s: \"no/*.png\"}]\n"), Contains("no file matches"));
  CHECK_THAT(said("pipeline: p\noevr: []\n"), Contains("unknown key \"oevr\" (did you mean \"over\"?)"));
  CHECK_THAT(said("pipeline: p\n"), Contains("varies nothing"));

  bench.write("all.yaml",
              "pipeline: pipeline.yaml\nover: [{smooth.neigbors: [1]}, {sequence: [data]}, {scn.x: [1]}]\n");
  const auto run = bench.sediment("sweep all.yaml --stages stages");
  CHECK(run.code == 2);
  CHECK_THAT(run.err, Contains("all.yaml:2: smooth.neigbors=1: unknown parameter \"neigbors\""));
  CHECK_THAT(run.err, Contains("unknown stage \"scn\""));
  CHECK(bench.sediment("sweep pipeline.yaml --stages stages").code == 2);
}

TEST_CASE("a sweep runs what instances share once, and its second run nothing") {
  const SweepBench bench;
  const auto first = bench.sweep("-j2" + bench.noted());
  REQUIRE(first.code == 0);
  const std::string started = bench.started();
  const auto count = [&](const std::string& stage) {
    std::size_t found = 0;
    for (std::size_t at = started.find(stage); at != std::string::npos; at = started.find(stage, at + 1))
      ++found;
    return found;
  };
  CHECK(count("scan") == 3);
  CHECK(count("smooth") == 9);
  CHECK(count("thin") == 18);
  CHECK(count("chart") == 18);
  CHECK_THAT(first.out, Contains("smooth     9    9       0"));
  const auto second = bench.sweep("-j2" + bench.noted());
  CHECK_THAT(second.out, Contains("72 kept in"));
  CHECK(bench.started().empty());
  CHECK_THAT(
      bench.read("out/all/more/smooth.neighbors=20,thin.factor=0.5,thin.manner=loud/chart/text.txt"),
      Contains("width: 5") && Contains("scan 40") && Contains("smooth 20 0.5") && Contains("thin 50 0.5"));
  const auto one = bench.sweep("-j2 --set smooth.words=x" + bench.noted());
  CHECK(one.code == 0);
  bench.started();
  // One parameter of one instance: exactly what is behind it.
  bench.shell("sed -i 's/0.25, 0.5/0.25, 0.75/' all.yaml");
  REQUIRE(bench.sweep(bench.noted()).code == 0);
  CHECK_THAT(bench.started(), !Contains("smooth"));
}

TEST_CASE("the planning commands see every instance of a sweep") {
  const SweepBench bench;
  REQUIRE(bench.sweep("--until smooth").code == 0);
  const auto call = [&](const std::string& text) { return bench.sediment(text + " --stages stages"); };
  CHECK_THAT(call("plan all.yaml").out, Contains("36 kept, 18 to run, 18 behind them"));
  const std::string label = "third/smooth.neighbors=30,thin.factor=0.5,thin.manner=loud";
  CHECK(call("why all.yaml " + label + "/thin").out == label + "/thin: runs (first run)\n");
  CHECK_THAT(call("log all.yaml " + label + "/smooth").out, Contains("--neighbors=30"));
  CHECK_THAT(call("status all.yaml").out, Contains(label + "/scan"));
  CHECK_THAT(call("graph all.yaml").out, Contains("chart\n"));
}

TEST_CASE("a table has the sizes of the files, in rows, columns and units as asked for") {
  const SweepBench bench;
  REQUIRE(bench.sweep().code == 0);
  const auto table = [&](const std::string& flags) { return bench.sediment("table out/all " + flags); };
  const Json rows =
      Json::parse(table("--value thin.text.txt --value thin.bytes/smooth.bytes --format json").out);
  REQUIRE(rows.size() == 18);
  for (const Json& row : rows) {
    const std::string folder = "out/all/" + row["sequence"].get<std::string>() +
                               "/smooth.neighbors=" + row["smooth.neighbors"].get<std::string>() +
                               ",thin.factor=" + row["thin.factor"].get<std::string>() +
                               ",thin.manner=" + row["thin.manner"].get<std::string>();
    const auto bytes = [&](const std::string& file) {
      return static_cast<double>(fs::file_size(bench / folder / file));
    };
    CHECK(row["thin.text.txt"] == bytes("thin/text.txt"));
    const double ratio = (bytes("thin/text.txt") + bytes("thin/metrics.json")) /
                         (bytes("smooth/text.txt") + bytes("smooth/metrics.json"));
    CHECK(row["thin.bytes/smooth.bytes"].get<double>() == Approx(ratio));
  }
  const auto pivot = table("--value 'chart.neighbors' --row sequence --columns smooth.neighbors");
  CHECK_THAT(
      pivot.out,
      Contains("| sequence | chart.neighbors, smooth.neighbors=10 | chart.neighbors, smooth.neighbors=20"));
  CHECK_THAT(pivot.out, Contains("| third    |                                   50 |"));
  CHECK_THAT(table("--value 'bytes [kB]' --row stage --aggregate max --format csv").out,
             Contains("stage,bytes [kB]\nscan,0.0"));
  CHECK_THAT(table("--value scan.bytes --row sequence --format latex").out, Contains("\\begin{tabular}{lr}"));
  CHECK_THAT(table("--value chart.bytes --row sequence").err,
             Contains("several different values fall into one cell"));
  CHECK_THAT(table("--value chart.byts").err,
             Contains("chart has no number \"byts\" (did you mean \"bytes\"?)"));
  CHECK_THAT(table("--row squence").err, Contains("unknown axis \"squence\" (did you mean \"sequence\"?)"));
  CHECK_THAT(table("--value 'scan.bytes [furlong]'").err, Contains("unknown unit"));
  CHECK(bench.sediment("table data").code == 2);
}

TEST_CASE("a table of a sweep in which a stage failed leaves out what was never reached") {
  const SweepBench bench;
  bench.write("all.yaml", "pipeline: pipeline.yaml\nover: [{smooth.fault: [none, fail]}]\n");
  REQUIRE(bench.sweep("--keep-going").code == 1);
  const auto table = bench.sediment("table out/all --value thin.text.txt --row smooth.fault --format csv");
  CHECK(table.code == 0);
  CHECK(table.out == "smooth.fault,thin.text.txt\nnone," +
                         std::to_string(fs::file_size(bench / "out/all/smooth.fault=none/thin/text.txt")) +
                         "\nfail,-\n");
}

TEST_CASE("compare shows in what two runs differ") {
  const Workbench bench;
  REQUIRE(bench.run().code == 0);
  const std::string run = "run pipeline.yaml --stages stages --store out/.sediment --out ";
  REQUIRE(bench.sediment(run + "second --set thin.neighbors=20 --set chart.words=x").code == 0);
  const auto compared = bench.sediment("compare out second --store out/.sediment");
  CHECK(compared.code == 0);
  CHECK_THAT(compared.out, Contains("thin: other bytes") && Contains("params/neighbors: 50 -> 20") &&
                               Contains("metrics/neighbors: 50 -> 20") &&
                               Contains("params/words: [] -> [\"x\"]"));
  CHECK_THAT(compared.out, Contains("2 results the same, 2 different, 0 only in the first"));
}
