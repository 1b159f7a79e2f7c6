// 8,000 instances: 1,000 chains of 8 trivial stages.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>

#include "benchmarks/runner/build_trees.hpp"
#include "benchmarks/runner/timed_call.hpp"
#include "pipeline/contract/parameter.hpp"
#include "tests/support/temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace sediment::benchmark;
using Catch::Contains;
using sediment::contract::Json;

namespace {

/// The stages that the last run says it ran.
std::vector<std::string> ran_in(const fs::path& runs) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(runs)) all.push_back(entry.path());
  const auto written = [](const fs::path& run) { return fs::last_write_time(run / "run.json"); };
  const auto last = *std::max_element(all.begin(), all.end(),
                                      [&](const auto& a, const auto& b) { return written(a) < written(b); });
  std::vector<std::string> ran;
  std::ifstream stream(last / "run.json");
  const Json run = Json::parse(stream);
  for (const Json& stage : run.at("stages")) ran.push_back(stage.at("stage"));
  return ran;
}

}  // namespace

TEST_CASE("one changed parameter in one of 8,000 instances runs exactly the stages behind it, in 100 MB") {
  const sediment::test::TemporaryFolder folder;
  const Tree tree = write_chains(folder.path(), 1000, 8);
  const auto call = call_of("sediment", tree.folder, 2);
  set_numbers(tree, 5, 0, 0);
  const Timed cold = timed_call(call, tree.folder);
  CHECK_THAT(cold.output, Contains("8000 ran in"));
  CHECK_THAT(timed_call(call, tree.folder).output, Contains("8000 kept in"));
  set_numbers(tree, 5, 0, 1);
  const Timed changed = timed_call(call, tree.folder);
  CHECK_THAT(changed.output, Contains("7996 kept, 4 ran in"));
  const std::string chain = "999/step5.number=1/step";
  CHECK(ran_in(tree.folder / "results/.sediment/runs") ==
        std::vector<std::string>{chain + "5", chain + "6", chain + "7", chain + "8"});
#ifndef __SANITIZE_ADDRESS__  // which keeps a shadow of all memory
  CHECK(std::max(cold.peak_mb, changed.peak_mb) < 100);
#endif
}
