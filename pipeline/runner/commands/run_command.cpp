#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <thread>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/commands/closing_table.hpp"
#include "pipeline/runner/commands/command_table.hpp"
#include "pipeline/runner/commands/opened_pipeline.hpp"
#include "pipeline/runner/execution/scheduler.hpp"
#include "pipeline/runner/store/pruning.hpp"

namespace sediment::runner {
namespace {

std::string run_id() {
  return fmt::format("{:%Y%m%dT%H%M%SZ}-{}", fmt::gmtime(std::time(nullptr)), getpid());
}

/// The record of the last run overlaid by this one: of a stage that failed the last good result stays known,
/// so that a later difference can be explained.
void record(const Instance& instance, const std::vector<Task>& tasks) {
  const Workspace workspace(instance.out);
  auto stages = workspace.read_record();
  const auto before = stages;
  for (const Task& task : tasks) {
    StageRecord& stage = stages[instance.graph->stages[task.stage_idx].name];
    const bool same = stage.key == task.key && !stage.state.empty();
    stage.state = name_of(task.outcome);
    stage.log = task.log;
    if (task.outcome == Outcome::kept || task.outcome == Outcome::ran) {
      stage.key = task.key;
      stage.object = task.object;
      stage.bytes = task.bytes;
    }
    if (task.outcome == Outcome::kept && same) continue;
    stage.why = task.why;
    stage.wall_s = task.wall_s;
    stage.peak_bytes = task.peak_bytes;
  }
  if (stages != before) workspace.write_record(stages);
}

/// Every stage must be able to run at all.
void check_resources(const Graph& graph, const Amounts& capacity) {
  for (const PlannedStage& stage : graph.stages)
    if (const std::string missing = shortage(stage.resources.amounts, capacity); !missing.empty())
      throw contract::UsageError("stage " + stage.name + ": " + missing);
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
  const auto started = std::chrono::steady_clock::now();
  Signals signals;
  OpenedPipeline opened = open_pipeline(arguments);
  Store& store = *opened.store;
  for (const PlannedStage& stage : opened.instance.graph->stages)
    Workspace(opened.instance.out).check(stage.name);
  RunOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : static_cast<int>(std::thread::hardware_concurrency());
  options.threads = arguments.threads;
  options.capacity = capacity_of_machine(arguments.resources);
  check_resources(*opened.instance.graph, options.capacity);
  options.keep_going = arguments.keep_going;
  options.check_space = !arguments.no_space_check;
  options.logs = store.root() / "runs" / run_id();
  store.make(arguments.durable);
  store.remove_dead_attempts();
  remember_workspace(store, opened.instance.out);
  Display display;
  const std::vector<Instance> instances{std::move(opened.instance)};
  Scheduler scheduler(instances, store, options, signals, display);
  const std::vector<Task> tasks = scheduler.run();
  store.memory().save();
  record(instances.front(), tasks);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  fmt::print("{}", closing_table(tasks, seconds));
  return exit_code(tasks, scheduler.interrupted());
}

}  // namespace sediment::runner
