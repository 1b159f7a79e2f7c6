// What a runner costs, apart from the work: chains of 8 trivial stages under sediment, ninja, make and
// snakemake in one run, cold and when there is nothing to do; 10,000 sources read by 30 stages; one changed
// parameter among all chains. Printed as Markdown, each goal with its verdict.
//   benchmark-runner [CHAINS...]          default: 100 1000
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "benchmarks/runner/build_trees.hpp"
#include "benchmarks/runner/timed_call.hpp"

using namespace sediment::benchmark;
namespace fs = std::filesystem;

namespace {

constexpr int kSteps = 8, kJobs = 2, kNoOps = 9;
/// snakemake 7 does not come to an end with 8,000 tasks.
constexpr int kMostTasksOfSnakemake = 1000;

struct Measured {
  double cold_ms_per_task = 0, no_op_ms = 0, peak_mb = 0;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void goal(const std::string& what, double found, double limit, const char* unit) {
  fmt::print("- {} {}: {:.2f} {}, goal at most {:.2f} {}\n", found <= limit ? "holds:" : "MISSED:", what,
             found, unit, limit, unit);
}

std::map<std::string, Measured> measure(const Tree& tree, const std::vector<std::string>& runners,
                                        int colds) {
  const double tasks = tree.chains * tree.steps;
  std::map<std::string, std::vector<double>> cold, no_op;
  std::map<std::string, Measured> measured;
  const auto call = [&](const std::string& runner) {
    const Timed timed = timed_call(call_of(runner, tree.folder, kJobs), tree.folder);
    measured[runner].peak_mb = std::max(measured[runner].peak_mb, timed.peak_mb);
    return 1000 * timed.seconds;
  };
  for (const std::string& runner : runners) {
    for (int i = 0; i < (runner == "snakemake" ? 1 : colds); ++i) {
      remove_results(tree);
      cold[runner].push_back(call(runner) / tasks);
    }
    call(runner);  // what was written a moment ago has settled
    for (int i = 0; i < (runner == "snakemake" ? 2 : kNoOps); ++i) no_op[runner].push_back(call(runner));
    measured[runner].cold_ms_per_task = median(cold[runner]);
    measured[runner].no_op_ms = median(no_op[runner]);
  }
  return measured;
}

void print(const std::string& what, const std::map<std::string, Measured>& measured) {
  for (const auto& [runner, one] : measured)
    fmt::print("| {} | {} | {:.3f} | {:.1f} | {:.1f} |\n", what, runner, one.cold_ms_per_task, one.no_op_ms,
               one.peak_mb);
  std::fflush(stdout);
}

/// How many stages a run says it ran.
std::string counts_in(const std::string& output) {
  const std::size_t end = output.rfind(" in ");
  return end == std::string::npos
             ? output
             : output.substr(output.rfind('\n', end) + 1, end - output.rfind('\n', end) - 1);
}

void one_change(const Tree& tree) {
  const auto call = call_of("sediment", tree.folder, kJobs);
  set_numbers(tree, 5, 0, 0);
  timed_call(call, tree.folder);
  set_numbers(tree, 5, 0, 1);
  const Timed timed = timed_call(call, tree.folder);
  const int tasks = tree.chains * tree.steps;
  const bool right = counts_in(timed.output) == fmt::format("{} kept, 4 ran", tasks - 4);
  fmt::print("- {} one changed parameter of step 5 in one of {} chains: {}, in {:.0f} ms\n",
             right ? "holds:" : "MISSED:", tree.chains, counts_in(timed.output), 1000 * timed.seconds);
}

std::vector<std::string> runners_for(int tasks) {
  std::vector<std::string> runners{"sediment"};
  for (const char* peer : {"ninja", "make", "snakemake"})
    if (is_installed(peer) && (tasks <= kMostTasksOfSnakemake || std::string(peer) != "snakemake"))
      runners.emplace_back(peer);
  return runners;
}

void compare_chains(const fs::path& folder, int chains) {
  const int tasks = chains * kSteps;
  const Tree tree = write_chains(folder / std::to_string(chains), chains, kSteps);
  auto measured = measure(tree, runners_for(tasks), chains <= 200 ? 3 : 1);
  fmt::print(
      "\n| chains of {} | runner | cold, ms a task | nothing to do, ms | peak memory, MB "
      "|\n|---|---|---|---|---|\n",
      kSteps);
  print(std::to_string(chains), measured);
  const Measured ours = measured["sediment"];
  fmt::print("\n");
  if (measured.contains("ninja")) {
    const Measured ninja = measured["ninja"];
    const bool many = tasks > kMostTasksOfSnakemake;
    goal("cold against ninja", ours.cold_ms_per_task / ninja.cold_ms_per_task, 1.2, "x");
    goal("nothing to do", ours.no_op_ms, std::max(many ? 120.0 : 15.0, (many ? 4 : 3) * ninja.no_op_ms),
         "ms");
  }
  if (measured.contains("snakemake"))
    goal("nothing to do against snakemake", ours.no_op_ms / measured["snakemake"].no_op_ms, 1.0 / 50, "x");
  goal("peak memory", ours.peak_mb, 100, "MB");
  one_change(tree);
  fs::remove_all(tree.folder);
}

void compare_wide(const fs::path& folder, int files, int steps) {
  const Tree tree = write_wide(folder / "wide", files, steps);
  const auto measured = measure(tree, runners_for(kMostTasksOfSnakemake + 1), 1);
  fmt::print(
      "\n| sources x stages | runner | cold, ms a task | nothing to do, ms | peak memory, MB "
      "|\n|---|---|---|---|---|\n");
  print(fmt::format("{} x {}", files, steps), measured);
  fmt::print("\n");
  goal("nothing to do", measured.at("sediment").no_op_ms, 40, "ms");
  fs::remove_all(tree.folder);
}

}  // namespace

int main(int argc, char** argv) try {
  const char* temporary = std::getenv("TMPDIR");
  const fs::path folder =
      fs::path(temporary == nullptr ? "/var/tmp" : temporary) / fmt::format("runner-{}", getpid());
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (argc == 1) sizes = {100, 1000};
  for (const int chains : sizes)
    if (chains > 0) compare_chains(folder, chains);
  compare_wide(folder, 10'000, 30);
  fs::remove_all(folder);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "benchmark-runner: %s\n", error.what());
  return 1;
}
