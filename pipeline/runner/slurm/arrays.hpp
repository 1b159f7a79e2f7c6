#pragma once

#include "pipeline/runner/slurm/packing.hpp"

namespace sediment::runner::slurm {

/// One array job.
struct Array {
  /// Starts when, of each of these arrays, the task of the same index has succeeded (aftercorr).
  std::vector<std::size_t> follows;
  /// Starts when these tasks have succeeded (afterok), given as an element or as a job: "12_3".
  std::vector<std::size_t> waits_for;
  std::vector<std::string> waits_for_jobs;
  Request request;
  std::size_t layer = 0;
  std::vector<std::pair<std::size_t, std::size_t>> tasks;  ///< index, element; by index
};

/// Array jobs for elements, in an order in which they can be submitted: with as few calls of sbatch as their
/// dependencies allow. Indices are below `most_tasks`.
std::vector<Array> arrays_of(const std::vector<Element>& elements, std::size_t most_tasks);

/// "0-3,7".
std::string index_text(const Array& array);

}  // namespace sediment::runner::slurm
