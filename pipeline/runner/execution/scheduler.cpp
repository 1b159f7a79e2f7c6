#include "pipeline/runner/execution/scheduler.hpp"

#include <signal.h>

#include <algorithm>
#include <set>
#include <utility>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/execution/disk_space.hpp"

namespace sediment::runner {
namespace {

constexpr int kTick_ms = 100, kLockRetry_ms = 20;
constexpr double kGrace_s = 5;

/// What an attempt asks for: with every retry twice the memory, as far as there is so much.
Amounts wanted(const PlannedStage& stage, int retries, const Amounts& capacity) {
  Amounts amounts = stage.resources.amounts;
  amounts.try_emplace("cpus", 1);
  if (const auto memory = amounts.find("memory"); memory != amounts.end())
    memory->second = std::min(memory->second << retries, capacity.at("memory"));
  return amounts;
}

}  // namespace

Scheduler::Scheduler(const std::vector<Instance>& instances, Store& store, RunOptions options,
                     Signals& signals, Display& display)
    : store_(store),
      options_(std::move(options)),
      signals_(signals),
      display_(display),
      board_(instances, store, display),
      crew_(options_.jobs, options_.capacity) {}

std::vector<Task> Scheduler::run() {
  adopt_orphans();
  while (true) {
    while (const auto task = board_.next()) decide(*task);
    launch_ready();
    if (const auto task = board_.next()) {
      decide(*task);
      continue;
    }
    if (crew_.empty() && (ready_.empty() || stopping_)) break;
    wait();
  }
  display_.end();
  return board_.take();
}

void Scheduler::decide(std::size_t task_idx) {
  Task& task = board_.task(task_idx);
  Key key = board_.key_of(task);
  task.key = key.id;
  if (const auto hit = store_.find(key.id)) {
    task.object = hit->object;
    task.bytes = hit->bytes;
    if (!board_.succeed(task_idx, Outcome::kept)) stopping_ = !options_.keep_going;
    return;
  }
  if (!board_.is_selected(task))
    return fail(task_idx, "is needed, is not in the store (" + board_.reason(task, key) +
                              ") and was not selected to run");
  const auto [in_work, is_first] = followers_.try_emplace(key.id);
  if (is_first)
    ready_.push_back({task_idx, std::move(key)});
  else
    in_work->second.push_back(task_idx);
}

/// Starts what can start. What finds no room or is locked by another runner stays, in its order.
void Scheduler::launch_ready() {
  locked_out_ = false;
  // Where one instance of a stage finds no room, none does: thousands may wait.
  std::set<std::pair<const PlannedStage*, int>> without_room;
  for (std::size_t i = 0; i < ready_.size() && !crew_.is_full() && !stopping_;) {
    const Task& task = board_.task(ready_[i].task);
    const std::pair kind(&board_.stage_of(task), task.retries);
    const Launch launched = without_room.contains(kind) ? Launch::no_room : launch(ready_[i]);
    if (launched == Launch::no_room) without_room.insert(kind);
    locked_out_ |= launched == Launch::locked;
    if (launched == Launch::done)
      ready_.erase(ready_.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
}

Scheduler::Launch Scheduler::launch(Waiting& waiting) {
  check_space();
  Task& task = board_.task(waiting.task);
  if (!crew_.has_room_for(wanted(board_.stage_of(task), task.retries, options_.capacity)))
    return Launch::no_room;
  try {
    auto lock = store_.try_lock(waiting.key.id);
    if (!lock) {
      display_.waits(task);
      return Launch::locked;
    }
    // Another runner may have made it between our look and our lock.
    if (store_.find(waiting.key.id)) {
      board_.reconsider(waiting.task);
      release_followers(task.key);
    } else {
      start(waiting, std::move(*lock));
    }
  } catch (const std::exception& error) {
    fail(waiting.task, error.what() + full_disk_note(store_.root()));
    release_followers(task.key);
  }
  return Launch::done;
}

void Scheduler::start(Waiting& waiting, KeyLock lock) {
  Task& task = board_.task(waiting.task);
  const PlannedStage& stage = board_.stage_of(task);
  task.why = board_.reason(task, waiting.key);
  const auto cpus = stage.resources.amounts.find("cpus");
  const int threads = options_.threads > 0 || cpus == stage.resources.amounts.end()
                          ? options_.threads
                          : static_cast<int>(cpus->second);
  Amounts taken = wanted(stage, task.retries, options_.capacity);
  auto attempt = std::make_unique<Attempt>(store_, std::move(lock), std::move(waiting.key), stage,
                                           board_.inputs_of(task), threads, task.why);
  const StageRecord* last = board_.last(task);
  const Crew::Member& member = crew_.add({waiting.task, std::move(taken), std::move(attempt)});
  task.lane = member.lane;
  task.started_s = std::chrono::duration<double>(member.attempt->started() - began_).count();
  display_.started(task, *member.attempt, last == nullptr ? 0 : last->wall_s);
}

void Scheduler::wait() {
  const auto seen = signals_.wait(locked_out_ ? kLockRetry_ms : kTick_ms);
  if (seen.interrupted) interrupt();
  if (seen.child_ended)
    while (auto ended = crew_.take_ended()) publish(std::move(*ended));
  display_.tick();
}

void Scheduler::publish(Crew::Ended ended) {
  const std::size_t task_idx = ended.member.task;
  Task& task = board_.task(task_idx);
  display_.stopped(task);
  task.wall_s = ended.member.attempt->seconds();
  task.cpu_s = ended.ending.cpu_s;
  task.peak_bytes = ended.ending.peak_bytes;
  if (interrupted_) return board_.fail(task_idx, Outcome::interrupted, "");
  try {
    const Receipt receipt = ended.member.attempt->finish(ended.ending);
    task.object = receipt.object;
    task.bytes = receipt.bytes;
    if (!board_.succeed(task_idx, Outcome::ran)) stopping_ = !options_.keep_going;
  } catch (const std::exception& error) {
    const std::string what = error.what() + full_disk_note(store_.root());
    task.log = save_log(task, ended.member.attempt->log());
    if (retries(ended, what))
      board_.reconsider(task_idx);
    else
      fail(task_idx, what);
  }
  ended.member.attempt.reset();  // removes its folder and frees the key
  release_followers(task.key);
}

/// Whether the stage is to be run again. A wrong call stays wrong.
bool Scheduler::retries(const Crew::Ended& ended, const std::string& what) {
  Task& task = board_.task(ended.member.task);
  const int allowed = board_.stage_of(task).resources.retries;
  if (task.retries >= allowed || stopping_ || ended.ending.exit_code == contract::kWrongCall) return false;
  ++task.retries;
  display_.retries(task, what, allowed);
  return true;
}

/// Keeps the log of a failed attempt.
std::string Scheduler::save_log(const Task& task, const std::filesystem::path& log) const {
  std::error_code error;
  std::filesystem::create_directories(options_.run, error);
  std::string name = task.label;
  std::replace(name.begin(), name.end(), '/', '.');
  if (task.retries > 0) name += '.' + std::to_string(task.retries);
  const std::filesystem::path saved = options_.run / (name + ".log");
  std::filesystem::rename(log, saved, error);
  return error ? "" : saved.string();
}

void Scheduler::fail(std::size_t task_idx, const std::string& what) {
  board_.fail(task_idx, Outcome::failed, what);
  if (!options_.keep_going) stopping_ = true;
}

void Scheduler::release_followers(const std::string& key) {
  const auto found = followers_.find(key);
  if (found == followers_.end()) return;
  for (const std::size_t task : found->second) board_.reconsider(task);
  followers_.erase(found);
}

/// Before the first stage starts: what is left to do must fit on the disk if it gets as large as it last was.
void Scheduler::check_space() {
  if (std::exchange(space_checked_, true) || !options_.check_space) return;
  check_room(store_.root(), board_.expected_bytes());
}

/// The first time the stages are asked to end and given a grace; the second time they are killed.
void Scheduler::interrupt() {
  const bool again = interrupted_;
  interrupted_ = stopping_ = true;
  crew_.signal(again ? SIGKILL : SIGTERM);
  if (!again) signals_.interrupt_again_after(kGrace_s);
}

}  // namespace sediment::runner
