#pragma once

#include "pipeline/runner/execution/signals.hpp"
#include "pipeline/runner/slurm/submitting.hpp"

namespace sediment::runner::slurm {

/// Brings results up to date with Slurm instead of this machine.
class Backend {
 public:
  Backend(std::vector<Instance>& instances, Store& store, std::string out, Setup setup)
      : instances_(instances), store_(store), out_(std::move(out)), setup_(std::move(setup)) {}

  /// Submits what is missing and says what. Returns whether nothing was.
  bool submit_missing();
  /// Waits until nothing is in flight, submits again what was lost or may be retried. Returns an exit code.
  int wait(Signals& signals);
  /// Leaves of the instances what has a result, so that the local executor only links and records.
  void keep_what_is_there();

 private:
  struct Look {
    std::vector<Work> works;
    std::vector<Progress> progress;
  };

  Look look(Observed& observed) const;
  void submit_open(const Look& now, const std::vector<bool>& open) const;
  bool wait_one_round();

  std::vector<Instance>& instances_;
  Store& store_;
  std::string out_;
  Setup setup_;
  std::string said_;  ///< last line of progress
};

/// "12 done, 3 running, 9 pending": how many works are in each state, in the order of the states.
std::string summary(const std::vector<Progress>& progress);

/// What stands in the way of a result, a row per work that failed, was lost or cancelled.
std::string table_of_faults(const std::vector<Work>& works, const std::vector<Instance>& instances,
                            const std::vector<Progress>& progress);

}  // namespace sediment::runner::slurm
