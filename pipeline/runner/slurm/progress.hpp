#pragma once

#include <string>
#include <vector>

#include "pipeline/runner/slurm/controller.hpp"
#include "pipeline/runner/slurm/submission.hpp"
#include "pipeline/runner/slurm/work.hpp"

namespace sediment::runner::slurm {

/// How far a work is. `cached`: it was there before anything was submitted; `lost`: it was submitted, there
/// is no receipt, and Slurm does not have it any more; `open`: never submitted.
enum class State { cached, done, running, pending, failed, blocked, lost, cancelled, unknown, open };

const char* name_of(State state);

struct Progress {
  State state = State::open;
  std::string why;   ///< why it is pending, or what went wrong
  std::string job;   ///< "12_3" that has or had it; empty if that is not known
  std::string log;   ///< file with what a failed stage said
  int attempts = 0;  ///< that failed or were lost, the last one included
  bool in_flight() const { return state == State::running || state == State::pending; }
  bool is_there() const { return state == State::cached || state == State::done; }
};

/// What has been submitted to a store and what Slurm knows of it, at one moment.
struct Observed {
  std::vector<Submission> submissions;
  Queue queue;
  std::string silence;  ///< why squeue did not answer; then what is not over is `unknown`
};
Observed observe(const Store& store);

/// By work. Receipts are the truth, so the works must be looked at after Slurm was: what ends in between is
/// done then, and not lost.
std::vector<Progress> progress_of(const std::vector<Work>& works, const std::vector<Instance>& instances,
                                  const Observed& observed, const Store& store);

}  // namespace sediment::runner::slurm
