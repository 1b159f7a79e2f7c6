#include "pipeline/runner/execution/board.hpp"

#include <algorithm>

namespace sediment::runner {

Board::Board(const std::vector<Instance>& instances, const Store& store, Display& display)
    : instances_(instances), store_(store), display_(display), tasks_(tasks_of(instances)) {
  for (const Instance& instance : instances_) objects_.emplace_back(instance.graph->stages.size());
  std::size_t open = 0;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    if (tasks_[i].outcome != Outcome::open) continue;
    ++open;
    if (tasks_[i].waits_for == 0) undecided_.insert(undecided_.end(), i);
  }
  display_.begin(open);
}

std::optional<std::size_t> Board::next() {
  if (undecided_.empty()) return std::nullopt;
  return undecided_.extract(undecided_.begin()).value();
}

Key Board::key_of(const Task& task) {
  const PlannedStage& stage = stage_of(task);
  return words_.try_emplace(&stage, stage)
      .first->second.key(*input_ids(instance_of(task), task.stage_idx, objects_[task.instance_idx]));
}

std::vector<std::filesystem::path> Board::inputs_of(const Task& task) const {
  return input_paths(instance_of(task), task.stage_idx, objects_[task.instance_idx], store_);
}

const StageRecord* Board::last(const Task& task) {
  const auto [record, fresh] = records_.try_emplace(task.instance_idx);
  if (fresh) record->second = Workspace(instance_of(task).out).read_record().stages;
  const auto stage = record->second.find(stage_of(task).name);
  return stage == record->second.end() ? nullptr : &stage->second;
}

std::string Board::reason(const Task& task, const Key& key) {
  return reason_for(key, last(task), store_).text;
}

bool Board::succeed(std::size_t idx, Outcome outcome) {
  Task& task = tasks_[idx];
  try {
    Workspace(instance_of(task).out).link(stage_of(task).name, task.object, store_);
  } catch (const std::exception& error) {
    fail(idx, Outcome::failed, std::string("its result cannot be linked: ") + error.what());
    return false;
  }
  task.outcome = outcome;
  display_.ended(task);
  objects_[task.instance_idx][task.stage_idx] = task.object;
  for (const std::size_t next : task.dependents)
    if (--tasks_[next].waits_for == 0) undecided_.insert(next);
  return true;
}

void Board::fail(std::size_t idx, Outcome outcome, const std::string& what) {
  tasks_[idx].outcome = outcome;
  tasks_[idx].why = what;
  display_.ended(tasks_[idx]);
  block_dependents(idx);
}

void Board::block_dependents(std::size_t idx) {
  for (const std::size_t next : tasks_[idx].dependents) {
    if (tasks_[next].outcome != Outcome::open) continue;
    tasks_[next].outcome = Outcome::blocked;
    tasks_[next].why = "behind " + tasks_[idx].label;
    block_dependents(next);
  }
}

std::uint64_t Board::expected_bytes() {
  std::uint64_t expected = 0;
  for (const Task& task : tasks_) {
    if (task.outcome != Outcome::open || !is_selected(task)) continue;
    if (const StageRecord* record = last(task)) expected += record->bytes;
  }
  return expected;
}

std::vector<Task> Board::take() {
  std::erase_if(tasks_, [](const Task& task) { return task.outcome == Outcome::skipped; });
  return std::move(tasks_);
}

}  // namespace sediment::runner
