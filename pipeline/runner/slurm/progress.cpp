#include "pipeline/runner/slurm/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace sediment::runner::slurm {
namespace {

/// The task that was last told to do a work.
struct Assigned {
  const Submission* submission;
  const Submission::Task* task;
  int attempt;
};

std::unordered_map<std::string, Assigned> assignments(const std::vector<Submission>& submissions) {
  std::unordered_map<std::string, Assigned> all;
  for (const Submission& submission : submissions)
    for (const Submission::Task& task : submission.tasks)
      for (std::size_t i = 0; i < task.works.size(); ++i)
        all[task.works[i]] = {&submission, &task, task.attempts[i]};
  return all;
}

const QueuedTask* queued(const Assigned& assigned, const Queue& queue) {
  const auto array = queue.find(assigned.submission->names[assigned.task->array]);
  if (array == queue.end()) return nullptr;
  const auto task = array->second.find(assigned.task->index);
  return task == array->second.end() ? nullptr : &task->second;
}

std::string job_of(const Assigned& assigned, const QueuedTask* queued) {
  if (queued != nullptr) return queued->job;
  const auto job = assigned.submission->jobs.find(assigned.task->array);
  if (job == assigned.submission->jobs.end()) return "";
  return fmt::format("{}_{}", job->second, assigned.task->index);
}

/// Judges work by work; those before a work have been judged.
class Judging {
 public:
  Judging(const std::vector<Work>& works, const std::vector<Instance>& instances, const Observed& observed,
          const Store& store)
      : works_(works),
        instances_(instances),
        observed_(observed),
        store_(store),
        assigned_(assignments(observed.submissions)) {}

  std::vector<Progress> judge() {
    for (const Work& work : works_) all_.push_back(judged(work));
    return std::move(all_);
  }

 private:
  Progress judged(const Work& work) {
    Progress progress;
    const auto found = assigned_.find(work.id);
    if (found == assigned_.end()) {
      progress.state = work.hit ? State::cached : State::open;
      return progress;
    }
    const Assigned& last = found->second;
    const QueuedTask* task = queued(last, observed_.queue);
    progress.job = job_of(last, task);
    progress.attempts = last.attempt;
    if (work.hit)
      progress.state = State::done;
    else if (task != nullptr && task->is_alive())
      set_alive(progress, work, *task);
    else
      set_over(progress, work, last, task);
    return progress;
  }

  void set_alive(Progress& progress, const Work& work, const QueuedTask& task) {
    if (const Work* bad = missing_before(work)) {
      progress.state = State::blocked;  // Slurm will notice soon
      progress.why = "behind " + label_of(*bad, instances_);
    } else if (task.state == "PENDING") {
      progress.state = State::pending;
      progress.why = task.reason;
    } else {
      const bool works = !work.key.empty() && store_.is_locked(work.key);
      progress.state = works ? State::running : State::pending;
      if (!works) progress.why = "its job is " + (task.state == "RUNNING" ? "running" : task.state);
    }
  }

  void set_over(Progress& progress, const Work& work, const Assigned& last, const QueuedTask* task) {
    const WorkEndings endings = endings_of(*last.submission, *last.task);
    const auto found = endings.find(work.id);
    const WorkEnding ending = found == endings.end() ? WorkEnding{} : found->second;
    const bool cancelled = last.submission->is_cancelled;
    // scancel ends the stages as it ends their runner, which may take that for a failure of theirs.
    if (ending.state == "failed" && !(cancelled && ending.why.find("was killed by signal") == 0)) {
      progress.state = State::failed;
      progress.why = ending.why;
      progress.log = ending.log;
      ++progress.attempts;
    } else if (cancelled) {
      progress.state = State::cancelled;
    } else if (ending.state == "kept" || ending.state == "ran") {
      progress.why = "its result is lost or damaged";
    } else if (const Work* bad = missing_before(work); bad != nullptr && !is_lost_with(*bad, last)) {
      progress.state = State::blocked;
      progress.why = "behind " + label_of(*bad, instances_);
    } else if (ending.state == "blocked") {
      progress.state = State::blocked;
      progress.why = ending.why;
    } else if (!observed_.silence.empty() && ending.state.empty()) {
      progress.state = State::unknown;
      progress.why = "squeue does not answer";
    } else {
      progress.state = State::lost;
      progress.why = task == nullptr ? "Slurm does not know its job" : "its job ended: " + task->state;
      ++progress.attempts;
    }
  }

  /// A work before it that will not come by itself.
  const Work* missing_before(const Work& work) const {
    for (const std::size_t read : work.reads) {
      const Progress& before = all_[read];
      if (!before.is_there() && !before.in_flight() && before.state != State::unknown) return &works_[read];
    }
    return nullptr;
  }

  /// Whether a work before got lost together with the task that had both.
  bool is_lost_with(const Work& before, const Assigned& last) const {
    const auto found = assigned_.find(before.id);
    const auto idx = static_cast<std::size_t>(&before - works_.data());
    return all_[idx].state == State::lost && found != assigned_.end() && found->second.task == last.task;
  }

  const std::vector<Work>& works_;
  const std::vector<Instance>& instances_;
  const Observed& observed_;
  const Store& store_;
  std::unordered_map<std::string, Assigned> assigned_;
  std::vector<Progress> all_;
};

}  // namespace

const char* name_of(State state) {
  switch (state) {
    case State::cached:
      return "cached";
    case State::done:
      return "done";
    case State::running:
      return "running";
    case State::pending:
      return "pending";
    case State::failed:
      return "failed";
    case State::blocked:
      return "blocked";
    case State::lost:
      return "lost";
    case State::cancelled:
      return "cancelled";
    case State::unknown:
      return "unknown";
    case State::open:
      return "to run";
  }
  return "";
}

Observed observe(const Store& store) {
  Observed observed{submissions_in(store), {}, ""};
  std::vector<std::string> names;
  for (const Submission& one : observed.submissions)
    names.insert(names.end(), one.names.begin(), one.names.end());
  try {
    observed.queue = queue_of(names);
  } catch (const std::exception& error) {
    observed.silence = error.what();
  }
  return observed;
}

std::vector<Progress> progress_of(const std::vector<Work>& works, const std::vector<Instance>& instances,
                                  const Observed& observed, const Store& store) {
  return Judging(works, instances, observed, store).judge();
}

}  // namespace sediment::runner::slurm
