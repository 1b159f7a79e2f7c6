#include "pipeline/runner/slurm/task_run.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/execution/closing_table.hpp"
#include "pipeline/runner/execution/run_record.hpp"
#include "pipeline/runner/execution/scheduler.hpp"
#include "pipeline/runner/slurm/order.hpp"
#include "pipeline/runner/slurm/submission.hpp"
#include "pipeline/runner/store/source_content.hpp"

namespace sediment::runner::slurm {
namespace {

namespace fs = std::filesystem;

/// The sources and programs must still be what was submitted: a receipt must not say what is not true.
void check_unchanged(const Order& order, Store& store) {
  FileDigests digests(store.memory(), false);
  std::map<std::string, std::string> ids;
  for (const Instance& instance : order.instances) {
    for (std::size_t i = 0; i < instance.source_ids.size(); ++i) {
      const fs::path& path = instance.source_paths[i];
      if (path.empty()) continue;
      std::string& id = ids[path.native()];
      if (id.empty()) id = source_id(instance.graph->sources[i].kind, path, digests);
      if (id != instance.source_ids[i])
        throw std::runtime_error("the source " + path.string() + " has changed since it was submitted");
    }
    for (std::size_t s = 0; s < instance.graph->stages.size(); ++s) {
      const Program& program = *instance.graph->stages[s].program;
      if (instance.selected[s] && digests.of(program.path).digest != program.digest)
        throw std::runtime_error("the program " + program.path.string() +
                                 " has changed since it was submitted");
    }
  }
}

RunOptions options_of(const Order& order, const Store& store, const std::string& id) {
  RunOptions options;
  options.capacity = capacity_of_machine({});
  for (const auto& [name, amount] : order.amounts) options.capacity[name] = amount;
  const int cpus = static_cast<int>(options.capacity["cpus"]);
  options.jobs = order.manner.jobs > 0 ? order.manner.jobs : std::max(1, cpus);
  options.threads = order.manner.threads;
  options.keep_going = true;  // what fails holds up only what stands behind it
  options.check_space = order.manner.check_space;
  options.run = store.root() / "runs" / id;
  return options;
}

/// run.json of an instance is read, changed and written; other tasks may be at the same one.
KeyLock lock_of_records(const Store& store) {
  while (true) {
    if (auto lock = store.try_lock("run-records")) return std::move(*lock);
    constexpr timespec kRetry{0, 20'000'000};
    nanosleep(&kRetry, nullptr);
  }
}

WorkEndings endings_of(const Order& order, const std::vector<Task>& tasks) {
  WorkEndings endings;
  for (const Task& task : tasks) {
    const std::string& work = order.works[task.instance_idx][task.stage_idx];
    if (!work.empty()) endings.try_emplace(work, WorkEnding{name_of(task.outcome), task.why, task.log});
  }
  return endings;
}

/// All works failed for a reason that is not theirs.
WorkEndings all_failed(const Order& order, const std::string& why) {
  WorkEndings endings;
  for (const auto& works : order.works)
    for (const std::string& work : works)
      if (!work.empty()) endings[work] = {"failed", why, ""};
  return endings;
}

std::vector<Task> execute(const Order& order, Store& store, const RunOptions& options, Signals& signals,
                          bool& interrupted) {
  const auto began = std::chrono::steady_clock::now();
  Display display;
  Scheduler scheduler(order.instances, store, options, signals, display);
  std::vector<Task> tasks = scheduler.run();
  interrupted = scheduler.interrupted();
  store.memory().save();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  write_run(options.run, tasks, seconds);
  {
    const KeyLock lock = lock_of_records(store);
    record(order.instances, tasks, options.run.string());
  }
  fmt::print("{}", closing_table(tasks, seconds));
  return tasks;
}

}  // namespace

int run_task(const fs::path& submission, std::size_t array, std::size_t index) {
  Signals signals;
  const Order order = read_order(submission, array, index);
  Store store(submission.parent_path().parent_path());
  store.make(order.manner.durable);
  const std::string id = fmt::format("{}-{}.{}", submission.filename().string(), array, index);
  try {
    check_unchanged(order, store);
    bool interrupted = false;
    const auto tasks = execute(order, store, options_of(order, store, id), signals, interrupted);
    write_endings(submission, array, index, endings_of(order, tasks));
    if (interrupted) return contract::kInterrupted;
    const bool all_done = std::all_of(tasks.begin(), tasks.end(), [](const Task& task) {
      return task.outcome == Outcome::kept || task.outcome == Outcome::ran;
    });
    return all_done ? contract::kDone : contract::kFailed;
  } catch (const std::exception& error) {
    write_endings(submission, array, index, all_failed(order, error.what()));
    throw;
  }
}

}  // namespace sediment::runner::slurm
