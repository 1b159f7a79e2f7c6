#pragma once

#include "pipeline/runner/slurm/arrays.hpp"

namespace sediment::runner::slurm {

/// How the tasks of a submission work.
struct Manner {
  int jobs = 0;     ///< stages of a task at the same time, 0 = as many as its cpus allow
  int threads = 0;  ///< of each stage, 0 = its cpus
  bool durable = false, check_space = true;
};

/// What a task of an array job is told to do.
struct Order {
  std::vector<Instance> instances;  ///< with what is to be done selected
  std::vector<std::vector<std::string>>
      works;        ///< by instance and stage: the id of the work, empty if not to do
  Amounts amounts;  ///< that it got
  Manner manner;
};

/// Writes the orders of all tasks into the folder of their submission.
void write_orders(const std::filesystem::path& folder, const std::vector<Array>& arrays,
                  const std::vector<Element>& elements, const std::vector<Work>& works,
                  const std::vector<Instance>& instances, const Manner& manner, const Profile& profile);

/// Throws std::runtime_error if there is none.
Order read_order(const std::filesystem::path& folder, std::size_t array, std::size_t index);

}  // namespace sediment::runner::slurm
