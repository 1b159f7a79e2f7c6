#pragma once

#include "pipeline/runner/slurm/order.hpp"
#include "pipeline/runner/slurm/progress.hpp"

namespace sediment::runner::slurm {

/// How a call wants its works submitted.
struct Setup {
  Packing packing;
  Profile profile;
  int in_flight = 0;  ///< tasks at the same time, 0 = as the profile says
  Manner manner;
};

/// What is submitted when the user asks for it: all that is neither there nor in flight. Throws
/// std::runtime_error if a work that is missing was not selected.
std::vector<bool> all_missing(const std::vector<Work>& works, const std::vector<Instance>& instances,
                              const std::vector<Progress>& progress);

/// What is submitted again without being asked: what was lost, what failed and has retries left, and what
/// stands behind those.
std::vector<bool> to_retry(const std::vector<Work>& works, const std::vector<Instance>& instances,
                           const std::vector<Progress>& progress);

/// The array jobs of one layer, as they were submitted.
struct SubmittedLayer {
  std::size_t works = 0, tasks = 0;
  std::vector<std::string> stages;  ///< names, each once
  std::vector<std::string> jobs;    ///< ids
};

/// Submits the open works for a folder of results. The caller holds the lock of submissions.
std::vector<SubmittedLayer> submit(const std::vector<Work>& works, const std::vector<Instance>& instances,
                                   const std::vector<Progress>& progress, const std::vector<bool>& open,
                                   const Setup& setup, const Store& store, const std::string& out);

/// Only one call submits to a store at a time. Waits for the other.
KeyLock lock_of_submissions(const Store& store);

/// Removes earlier submissions for a folder of which nothing is alive and nothing is missing.
void remove_settled(const std::vector<Work>& works, const std::vector<Progress>& progress,
                    const Observed& observed, const std::string& out);

}  // namespace sediment::runner::slurm
