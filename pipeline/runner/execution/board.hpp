#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "pipeline/runner/execution/display.hpp"
#include "pipeline/runner/execution/plan.hpp"
#include "pipeline/runner/execution/task.hpp"

namespace sediment::runner {

/// The state of all tasks of a run: what can be decided next, what has ended and what that means for those
/// behind.
class Board {
 public:
  Board(const std::vector<Instance>& instances, const Store& store, Display& display);

  Task& task(std::size_t idx) { return tasks_[idx]; }
  const Instance& instance_of(const Task& task) const { return instances_[task.instance_idx]; }
  const PlannedStage& stage_of(const Task& task) const {
    return instance_of(task).graph->stages[task.stage_idx];
  }
  bool is_selected(const Task& task) const { return instance_of(task).selected[task.stage_idx]; }

  /// The next task of which all inputs are known; nothing if there is none.
  std::optional<std::size_t> next();
  /// Puts a task back among those to decide.
  void reconsider(std::size_t idx) { undecided_.insert(idx); }

  Key key_of(const Task& task);
  std::vector<std::filesystem::path> inputs_of(const Task& task) const;
  /// Why a task with that key has to run.
  std::string reason(const Task& task, const Key& key);
  /// The record of the last run of the task's stage, if there is one.
  const StageRecord* last(const Task& task);

  /// The result is there: links it and sets those behind it free. If it cannot be linked the task has failed.
  bool succeed(std::size_t idx, Outcome outcome);
  /// Those behind it are blocked.
  void fail(std::size_t idx, Outcome outcome, const std::string& what);

  /// Sum of the sizes that the results of all open tasks last had.
  std::uint64_t expected_bytes();
  /// The tasks, without those that nothing needs.
  std::vector<Task> take();

 private:
  void block_dependents(std::size_t idx);

  const std::vector<Instance>& instances_;
  const Store& store_;
  Display& display_;
  std::vector<Task> tasks_;
  std::vector<std::vector<std::string>> objects_;  ///< of each stage of each instance, as far as known
  std::map<std::size_t, std::map<std::string, StageRecord>> records_;  ///< by instance, read on demand
  std::set<std::size_t> undecided_;
  std::unordered_map<const PlannedStage*, KeyWords> words_;
};

}  // namespace sediment::runner
