#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <thread>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/bring_up_to_date.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/opened_config.hpp"
#include "pipeline/runner/commands/slurm_setup.hpp"
#include "pipeline/runner/execution/closing_table.hpp"
#include "pipeline/runner/execution/run_record.hpp"
#include "pipeline/runner/execution/scheduler.hpp"
#include "pipeline/runner/slurm/backend.hpp"
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

void prepare(const OpenedConfig& opened, bool durable) {
  if (opened.points.empty())
    for (const PlannedStage& stage : opened.instances.front().graph->stages)
      Workspace(opened.out).check(stage.name);
  opened.store->make(durable);
  opened.store->attempts().tidy();
  remember_workspace(*opened.store, opened.out);
  if (!opened.points.empty()) write_points(opened.points, opened.out);
}

/// With the local executor.
int execute(const OpenedConfig& opened, const RunOptions& options, Signals& signals, bool show_table) {
  const auto began = std::chrono::steady_clock::now();
  Store& store = *opened.store;
  Display display;
  Scheduler scheduler(opened.instances, store, options, signals, display);
  const std::vector<Task> tasks = scheduler.run();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  store.memory().save();
  const bool all_kept =
      std::all_of(tasks.begin(), tasks.end(), [](const Task& task) { return task.outcome == Outcome::kept; });
  // Once more: a stage of a killed runner may have gone on writing for the moment that its death took.
  store.attempts().tidy();
  if (!all_kept) write_run(options.run, tasks, seconds);
  record(opened.instances, tasks, all_kept ? "" : options.run.string());
  if (show_table) fmt::print("{}", closing_table(tasks, seconds));
  return exit_code(tasks, scheduler.interrupted());
}

/// With Slurm. What is there afterwards is linked and recorded here.
Ran run_on_slurm(OpenedConfig& opened, const Arguments& arguments, Signals& signals) {
  prepare(opened, arguments.durable);
  slurm::Backend backend(opened.instances, *opened.store, opened.out.string(), slurm_setup_of(arguments));
  bool complete = backend.submit_missing();
  int code = contract::kDone;
  if (!complete && arguments.wait) {
    code = backend.wait(signals);
    complete = code == contract::kDone;
  }
  backend.keep_what_is_there();
  const int kept = execute(opened, options_of(arguments, *opened.store), signals, complete);
  return {code == contract::kDone ? kept : code, complete};
}

}  // namespace

Ran bring_up_to_date(const Arguments& arguments) {
  Signals signals;
  OpenedConfig opened = open_config(arguments);
  if (arguments.backend == "slurm") return run_on_slurm(opened, arguments, signals);
  const RunOptions options = options_of(arguments, *opened.store);
  for (const Instance& instance : opened.instances) check_resources(*instance.graph, options.capacity);
  prepare(opened, arguments.durable);
  return {execute(opened, options, signals, true), true};
}

int run(const Arguments& arguments) {
  return bring_up_to_date(arguments).code;
}

}  // namespace sediment::runner
