#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <thread>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/opened_config.hpp"
#include "pipeline/runner/execution/closing_table.hpp"
#include "pipeline/runner/execution/run_record.hpp"
#include "pipeline/runner/execution/scheduler.hpp"
#include "pipeline/runner/store/pruning.hpp"

namespace sediment::runner {
namespace {

std::string run_id() {
  return fmt::format("{:%Y%m%dT%H%M%SZ}-{}", fmt::gmtime(std::time(nullptr)), getpid());
}

/// Every stage must be able to run at all.
void check_resources(const Graph& graph, const Amounts& capacity) {
  for (const PlannedStage& stage : graph.stages)
    if (const std::string missing = shortage(stage.resources.amounts, capacity); !missing.empty())
      throw contract::UsageError("stage " + stage.name + ": " + missing);
}

RunOptions options_of(const Arguments& arguments, const Store& store) {
  RunOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : static_cast<int>(std::thread::hardware_concurrency());
  options.threads = arguments.threads;
  options.capacity = capacity_of_machine(arguments.resources);
  options.keep_going = arguments.keep_going;
  options.check_space = !arguments.no_space_check;
  options.run = store.root() / "runs" / run_id();
  return options;
}

int exit_code(const std::vector<Task>& tasks, bool interrupted) {
  if (interrupted) return contract::kInterrupted;
  const bool all_done = std::all_of(tasks.begin(), tasks.end(), [](const Task& task) {
    return task.outcome == Outcome::kept || task.outcome == Outcome::ran;
  });
  return all_done ? contract::kDone : contract::kFailed;
}

}  // namespace

int run(const Arguments& arguments) {
  const auto began = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  Signals signals;
  const OpenedConfig opened = open_config(arguments);
  Store& store = *opened.store;
  const RunOptions options = options_of(arguments, store);
  for (const Instance& instance : opened.instances) check_resources(*instance.graph, options.capacity);
  if (opened.points.empty())
    for (const PlannedStage& stage : opened.instances.front().graph->stages)
      Workspace(opened.out).check(stage.name);
  store.make(arguments.durable);
  store.remove_leftovers();
  remember_workspace(store, opened.out);
  if (!opened.points.empty()) write_points(opened.points, opened.out);

  Display display;
  Scheduler scheduler(opened.instances, store, options, signals, display);
  const std::vector<Task> tasks = scheduler.run();
  store.memory().save();
  const bool all_kept =
      std::all_of(tasks.begin(), tasks.end(), [](const Task& task) { return task.outcome == Outcome::kept; });
  // Once more: a stage of a killed runner may have gone on writing for the moment that its death took.
  store.remove_leftovers();
  if (!all_kept) write_run(options.run, tasks, seconds());
  record(opened.instances, tasks, all_kept ? "" : options.run.string());
  fmt::print("{}", closing_table(tasks, seconds()));
  return exit_code(tasks, scheduler.interrupted());
}

}  // namespace sediment::runner
