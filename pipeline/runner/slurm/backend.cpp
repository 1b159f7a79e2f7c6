#include "pipeline/runner/slurm/backend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/execution/text_table.hpp"

namespace sediment::runner::slurm {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Squeue is asked more rarely the longer a sweep takes: a busy controller should not feel it.
constexpr milliseconds kSoonest{200}, kLatest{5000};
constexpr int kShareOfTime = 20;

/// Returns early, with true, if the user interrupts. Ends of our own calls of squeue also wake us up.
bool interrupted_within(milliseconds time, Signals& signals) {
  const auto end = steady_clock::now() + time;
  while (true) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - steady_clock::now()).count();
    if (left <= 0) return false;
    if (signals.wait(static_cast<int>(left)).interrupted) return true;
  }
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

bool any(const std::vector<Progress>& progress, State state) {
  return std::any_of(progress.begin(), progress.end(),
                     [&](const Progress& one) { return one.state == state; });
}

}  // namespace

std::string summary(const std::vector<Progress>& progress) {
  std::map<State, std::size_t> counts;
  for (const Progress& one : progress) ++counts[one.state];
  std::vector<std::string> parts;
  for (const auto& [state, count] : counts) parts.push_back(fmt::format("{} {}", count, name_of(state)));
  return joined(parts, ", ");
}

std::string table_of_faults(const std::vector<Work>& works, const std::vector<Instance>& instances,
                            const std::vector<Progress>& progress) {
  std::vector<std::vector<std::string>> rows{{"stage", "state", "job", "why", "log"}};
  for (std::size_t w = 0; w < works.size(); ++w) {
    const Progress& one = progress[w];
    if (one.is_there() || one.in_flight() || one.state == State::blocked) continue;
    rows.push_back({label_of(works[w], instances), name_of(one.state), one.job, one.why, one.log});
  }
  return rows.size() > 1 ? aligned(rows, {}) : "";
}

Backend::Look Backend::look(Observed& observed) const {
  observed = observe(store_);
  Look now{works_of(instances_, store_), {}};
  now.progress = progress_of(now.works, instances_, observed, store_);
  return now;
}

bool Backend::submit_missing() {
  check_commands();
  const KeyLock lock = lock_of_submissions(store_);
  Observed observed;
  const Look now = look(observed);
  const auto open = all_missing(now.works, instances_, now.progress);
  const bool is_complete = std::all_of(now.progress.begin(), now.progress.end(),
                                       [](const Progress& one) { return one.is_there(); });
  if (is_complete) return true;
  if (!observed.silence.empty())
    throw std::runtime_error("nothing is submitted, because nobody knows what is in flight: " +
                             observed.silence);
  remove_settled(now.works, now.progress, observed, out_);
  if (std::count(open.begin(), open.end(), true) > 0)
    submit_open(now, open);
  else
    fmt::print("nothing to submit: {}\n", summary(now.progress));
  std::fflush(stdout);
  return false;
}

void Backend::submit_open(const Look& now, const std::vector<bool>& open) const {
  const auto layers = submit(now.works, instances_, now.progress, open, setup_, store_, out_);
  std::size_t works = 0, tasks = 0, jobs = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const SubmittedLayer& layer = layers[i];
    fmt::print("layer {}: {} tasks for {} stages ({}) in array jobs {}\n", i + 1, layer.tasks, layer.works,
               joined(layer.stages, ", "), joined(layer.jobs, " "));
    works += layer.works;
    tasks += layer.tasks;
    jobs += layer.jobs.size();
  }
  const auto count = [&](auto which) {
    return std::count_if(now.progress.begin(), now.progress.end(), which);
  };
  fmt::print("submitted {} stages in {} tasks of {} array jobs; {} are there, {} were in flight\n", works,
             tasks, jobs, count([](const Progress& one) { return one.is_there(); }),
             count([](const Progress& one) { return one.in_flight(); }));
}

/// Whether there is anything left to wait for.
bool Backend::wait_one_round() {
  const KeyLock lock = lock_of_submissions(store_);
  Observed observed;
  const Look now = look(observed);
  const std::string line =
      observed.silence.empty() ? summary(now.progress) : "squeue does not answer; waiting";
  if (line != said_) fmt::print(stderr, "slurm: {}\n", line);
  said_ = line;
  if (!observed.silence.empty()) return true;
  const auto open = to_retry(now.works, instances_, now.progress);
  const bool again = std::count(open.begin(), open.end(), true) > 0;
  try {
    if (again) submit_open(now, open);
  } catch (const std::runtime_error& error) {
    // What did not get through counts as lost in the next round, and is not tried for ever.
    fmt::print(stderr, "slurm: {}\n", error.what());
  }
  return again || any(now.progress, State::running) || any(now.progress, State::pending);
}

int Backend::wait(Signals& signals) {
  const auto began = steady_clock::now();
  while (wait_one_round()) {
    const auto passed = std::chrono::duration_cast<milliseconds>(steady_clock::now() - began);
    if (!interrupted_within(std::clamp(passed / kShareOfTime, kSoonest, kLatest), signals)) continue;
    fmt::print(stderr, "slurm: what is submitted goes on; `sediment cancel` ends it\n");
    return contract::kInterrupted;
  }
  Observed observed;
  const Look now = look(observed);
  fmt::print("{}", table_of_faults(now.works, instances_, now.progress));
  const bool is_complete = std::all_of(now.progress.begin(), now.progress.end(),
                                       [](const Progress& one) { return one.is_there(); });
  if (!is_complete) fmt::print("{}\n", summary(now.progress));
  return is_complete ? contract::kDone : contract::kFailed;
}

void Backend::keep_what_is_there() {
  std::vector<std::vector<bool>> there;
  for (const Instance& instance : instances_) there.emplace_back(instance.needed.size());
  for (const Work& work : works_of(instances_, store_))
    for (const Place& place : work.places) there[place.instance_idx][place.stage_idx] = work.hit.has_value();
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    instances_[i].selected.assign(there[i].size(), false);
    instances_[i].needed = std::move(there[i]);
  }
}

}  // namespace sediment::runner::slurm
