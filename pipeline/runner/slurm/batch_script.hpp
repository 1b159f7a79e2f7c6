#pragma once

#include "pipeline/runner/slurm/arrays.hpp"

namespace sediment::runner::slurm {

/// The batch script of an array job. All that is said to sbatch stands in it.
struct BatchScript {
  std::filesystem::path submission;  ///< folder
  std::size_t number = 0;            ///< of the array
  std::string name;                  ///< of the job
  int in_flight = 0;                 ///< tasks at the same time, 0 = no limit
  std::string dependency;            ///< "afterok:12_0:12_1", or empty
};
std::string text_of(const BatchScript& script, const Array& array);

/// What an array waits for, given where each element is and the jobs submitted so far.
struct SubmittedArrays {
  std::vector<std::string> jobs;                                ///< by array
  std::vector<std::pair<std::size_t, std::size_t>> element_at;  ///< by element: array, index
};
std::string dependency_of(const Array& array, const SubmittedArrays& submitted);

}  // namespace sediment::runner::slurm
