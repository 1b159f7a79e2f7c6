#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sediment::runner::slurm {

/// What squeue knows of a task of an array job.
struct QueuedTask {
  std::string job;     ///< "12_3"
  std::string state;   ///< PENDING, RUNNING, ..., also of those that ended a few minutes ago
  std::string reason;  ///< why it is pending
  bool is_alive() const;
};

/// Tasks by the name of their array job and their index.
using Queue = std::map<std::string, std::map<std::size_t, QueuedTask>>;

/// Asks squeue for the array jobs of these names. Throws std::runtime_error if nobody answers.
Queue queue_of(const std::vector<std::string>& names);

/// Submits a batch script; returns the job's id. Throws std::runtime_error with what sbatch said.
std::string submit(const std::filesystem::path& script);

void cancel(const std::vector<std::string>& jobs);

/// How many tasks an array job may have (MaxArraySize, max_array_tasks).
std::size_t most_array_tasks();

/// Throws contract::UsageError if this is no machine with Slurm's commands.
void check_commands();

}  // namespace sediment::runner::slurm
