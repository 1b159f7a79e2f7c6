#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/runner/execution/instance.hpp"

namespace sediment::runner {

enum class Outcome { open, kept, ran, failed, blocked, interrupted, skipped };

/// The name of an outcome in tables and records; `open` reads "not run".
const char* name_of(Outcome outcome);

/// A stage of an instance, in a run.
struct Task {
  std::string label;  ///< stage, or instance/stage
  std::size_t instance_idx = 0, stage_idx = 0;
  Outcome outcome = Outcome::open;
  std::string key, object;
  std::string why;  ///< why it ran, or what went wrong
  std::string log;  ///< file with what a failed stage said
  double wall_s = 0, cpu_s = 0;
  int retries = 0;  ///< attempts that failed before
  std::uint64_t bytes = 0, peak_bytes = 0;
  double started_s = 0;  ///< since the run began
  int lane = -1;         ///< in a picture of the run; no two stages of a lane ran at the same time
  int waits_for = 0;     ///< stages before it that have not ended
  std::vector<std::size_t> dependents;
};

/// A task per stage of each instance, instance by instance. What nothing needs is skipped.
std::vector<Task> tasks_of(const std::vector<Instance>& instances);

}  // namespace sediment::runner
