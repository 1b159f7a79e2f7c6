#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/contract/parameter.hpp"
#include "pipeline/runner/store/store.hpp"

namespace sediment::runner::slurm {

/// What was submitted by one call: a folder STORE/slurm/<id>, so that everybody who sees the store knows of
/// it. It is written before the first job is submitted and stays as it is, but for notes that are added.
struct Submission {
  struct Task {  ///< of an array job
    std::size_t array = 0, index = 0;
    std::vector<std::string> works;  ///< their ids
    std::vector<int> attempts;       ///< of each work: those before this one that failed
  };

  std::filesystem::path folder;
  std::string out;                 ///< folder of results that it was submitted for
  std::vector<std::string> names;  ///< of the array jobs
  std::vector<Task> tasks;
  std::map<std::size_t, std::string> jobs;  ///< ids, by array; one may be missing after a crash
  bool is_cancelled = false;
};

void write(const Submission& submission);
/// Adds the id of an array job.
void note_job(const Submission& submission, std::size_t array, const std::string& job);
void note_cancelled(const Submission& submission);

/// All submissions to a store, the oldest first.
std::vector<Submission> submissions_in(const Store& store);

/// How a work ended in a task: "kept", "ran", "failed", "blocked", "interrupted".
struct WorkEnding {
  std::string state, why, log;
};
using WorkEndings = std::map<std::string, WorkEnding>;

/// Left by a task at its end. One that was killed leaves none: then this is empty.
WorkEndings endings_of(const Submission& submission, const Submission::Task& task);
void write_endings(const std::filesystem::path& folder, std::size_t array, std::size_t index,
                   const WorkEndings& endings);

/// Writes a file that is whole or absent. Throws std::runtime_error naming it.
void write_whole(const std::filesystem::path& file, const std::string& text);

}  // namespace sediment::runner::slurm
