#include "pipeline/runner/execution/scheduler.hpp"

#include <signal.h>

#include <algorithm>
#include <utility>

#include "pipeline/runner/execution/disk_space.hpp"

namespace sediment::runner {
namespace {

constexpr int kTick_ms = 100, kLockRetry_ms = 20;
constexpr double kGrace_s = 5;

}  // namespace

Scheduler::Scheduler(const std::vector<Instance>& instances, Store& store, RunOptions options,
                     Signals& signals, Display& display)
    : instances_(instances),
      store_(store),
      options_(std::move(options)),
      signals_(signals),
      display_(display) {}

std::vector<Task> Scheduler::run() {
  tasks_ = tasks_of(instances_);
  for (const Instance& instance : instances_) objects_.emplace_back(instance.graph->stages.size());
  for (std::size_t i = 0; i < tasks_.size(); ++i)
    if (tasks_[i].waits_for == 0 && tasks_[i].outcome == Outcome::open) undecided_.insert(i);
  display_.begin(static_cast<std::size_t>(std::count_if(
      tasks_.begin(), tasks_.end(), [](const Task& task) { return task.outcome == Outcome::open; })));
  while (true) {
    locked_out_ = false;
    while (!undecided_.empty()) decide(undecided_.extract(undecided_.begin()).value());
    launch_ready();
    if (!undecided_.empty()) continue;
    if (running_.empty() && (ready_.empty() || stopping_)) break;
    wait();
  }
  display_.end();
  std::erase_if(tasks_, [](const Task& task) { return task.outcome == Outcome::skipped; });
  return std::move(tasks_);
}

void Scheduler::decide(std::size_t task_idx) {
  Task& task = tasks_[task_idx];
  const Instance& instance = instances_[task.instance_idx];
  const PlannedStage& stage = instance.graph->stages[task.stage_idx];
  Key key = key_of(stage, *input_ids(instance, task.stage_idx, objects_[task.instance_idx]));
  task.key = key.id;
  if (const auto hit = store_.find(key.id)) return keep(task_idx, *hit);
  if (!instance.selected[task.stage_idx])
    return fail(task_idx,
                "is needed, is not in the store (" + reason(task, key) + ") and was not selected to run");
  if (const auto in_work = followers_.find(key.id); in_work != followers_.end()) {
    in_work->second.push_back(task_idx);
    return;
  }
  followers_[key.id];
  ready_.push_back({task_idx, std::move(key)});
}

void Scheduler::launch_ready() {
  std::deque<Waiting> busy;
  while (!ready_.empty() && !stopping_ && running_.size() < static_cast<std::size_t>(options_.jobs)) {
    Waiting waiting = std::move(ready_.front());
    ready_.pop_front();
    if (!launch(waiting)) busy.push_back(std::move(waiting));
  }
  locked_out_ = !busy.empty();
  ready_.insert(ready_.end(), std::make_move_iterator(busy.begin()), std::make_move_iterator(busy.end()));
}

bool Scheduler::launch(Waiting waiting) {
  check_space();
  Task& task = tasks_[waiting.task];
  const Instance& instance = instances_[task.instance_idx];
  try {
    auto lock = store_.try_lock(waiting.key.id);
    if (!lock) {
      display_.waits(task);
      return false;
    }
    // Another runner may have made it between our look and our lock.
    if (const auto hit = store_.find(waiting.key.id)) {
      keep(waiting.task, *hit);
      release_followers(task.key);
      return true;
    }
    task.why = reason(task, waiting.key);
    auto attempt = std::make_unique<Attempt>(
        store_, std::move(*lock), std::move(waiting.key), instance.graph->stages[task.stage_idx],
        input_paths(instance, task.stage_idx, objects_[task.instance_idx], store_), options_.threads,
        task.why);
    running_.push_back({waiting.task, task.key, std::move(attempt)});
    display_.started(task, *running_.back().attempt);
  } catch (const std::exception& error) {
    fail(waiting.task, error.what() + full_disk_note(store_.root()));
    release_followers(task.key);
  }
  return true;
}

void Scheduler::wait() {
  const auto seen = signals_.wait(locked_out_ ? kLockRetry_ms : kTick_ms);
  if (seen.interrupted) interrupt();
  if (seen.child_ended) reap_ended();
  display_.tick();
}

void Scheduler::reap_ended() {
  for (auto one = running_.begin(); one != running_.end();) {
    const auto ending = reap(one->attempt->pid());
    if (!ending) {
      ++one;
      continue;
    }
    display_.stopped(tasks_[one->task]);
    signal_group(one->attempt->pid(), SIGKILL);  // whatever it left behind
    publish(*one, *ending);
    const std::string key = one->key;
    one = running_.erase(one);  // removes the attempt's folder and frees the key
    release_followers(key);
  }
}

void Scheduler::publish(Running& running, const Ending& ending) {
  Task& task = tasks_[running.task];
  task.wall_s = running.attempt->seconds();
  task.peak_bytes = ending.peak_bytes;
  if (interrupted_) {
    end(running.task, Outcome::interrupted);
    return block_dependents(running.task);
  }
  try {
    const Receipt receipt = running.attempt->finish(ending);
    task.object = receipt.object;
    task.bytes = receipt.bytes;
    succeed(running.task, Outcome::ran);
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::create_directories(options_.logs, ignored);
    std::string name = task.label;
    std::replace(name.begin(), name.end(), '/', '.');
    const auto log = options_.logs / (name + ".log");
    std::filesystem::rename(running.attempt->log(), log, ignored);
    if (!ignored) task.log = log;
    fail(running.task, error.what() + full_disk_note(store_.root()));
  }
}

void Scheduler::keep(std::size_t task_idx, const Hit& hit) {
  tasks_[task_idx].object = hit.object;
  tasks_[task_idx].bytes = hit.bytes;
  succeed(task_idx, Outcome::kept);
}

/// A result that is there, made or kept.
void Scheduler::succeed(std::size_t task_idx, Outcome outcome) {
  const Task& task = tasks_[task_idx];
  const Instance& instance = instances_[task.instance_idx];
  try {
    Workspace(instance.out).link(instance.graph->stages[task.stage_idx].name, task.object, store_);
  } catch (const std::exception& error) {
    return fail(task_idx, std::string("its result cannot be linked: ") + error.what());
  }
  end(task_idx, outcome);
  objects_[task.instance_idx][task.stage_idx] = task.object;
  for (const std::size_t next : task.dependents)
    if (--tasks_[next].waits_for == 0) undecided_.insert(next);
}

void Scheduler::end(std::size_t task_idx, Outcome outcome) {
  tasks_[task_idx].outcome = outcome;
  display_.ended(tasks_[task_idx]);
}

void Scheduler::fail(std::size_t task_idx, const std::string& what) {
  tasks_[task_idx].why = what;
  end(task_idx, Outcome::failed);
  block_dependents(task_idx);
  if (!options_.keep_going) stopping_ = true;
}

void Scheduler::block_dependents(std::size_t task_idx) {
  for (const std::size_t next : tasks_[task_idx].dependents) {
    Task& task = tasks_[next];
    if (task.outcome != Outcome::open) continue;
    task.outcome = Outcome::blocked;
    task.why = "behind " + tasks_[task_idx].label;
    block_dependents(next);
  }
}

void Scheduler::release_followers(const std::string& key) {
  const auto found = followers_.find(key);
  if (found == followers_.end()) return;
  const std::vector<std::size_t> waiting = std::move(found->second);
  followers_.erase(found);
  undecided_.insert(waiting.begin(), waiting.end());
}

std::string Scheduler::reason(const Task& task, const Key& key) {
  const std::string& stage = instances_[task.instance_idx].graph->stages[task.stage_idx].name;
  return reason_for(key, stage, record(task.instance_idx), store_).text;
}

const std::map<std::string, StageRecord>& Scheduler::record(std::size_t instance_idx) {
  const auto [record, fresh] = records_.try_emplace(instance_idx);
  if (fresh) record->second = Workspace(instances_[instance_idx].out).read_record();
  return record->second;
}

/// Before the first stage starts: what is left to do must fit on the disk if it gets as large as it last was.
void Scheduler::check_space() {
  if (std::exchange(space_checked_, true) || !options_.check_space) return;
  std::uint64_t expected = 0;
  for (const Task& task : tasks_) {
    const Instance& instance = instances_[task.instance_idx];
    if (task.outcome != Outcome::open || !instance.selected[task.stage_idx]) continue;
    const auto& last = record(task.instance_idx);
    const auto stage = last.find(instance.graph->stages[task.stage_idx].name);
    if (stage != last.end()) expected += stage->second.bytes;
  }
  check_room(store_.root(), expected);
}

/// The first time the stages are asked to end and given a grace; the second time they are killed.
void Scheduler::interrupt() {
  const bool again = interrupted_;
  interrupted_ = stopping_ = true;
  for (const Running& one : running_) signal_group(one.attempt->pid(), again ? SIGKILL : SIGTERM);
  if (!again) signals_.interrupt_again_after(kGrace_s);
}

}  // namespace sediment::runner
