#pragma once

#include "pipeline/runner/config/graph.hpp"
#include "pipeline/runner/slurm/profile.hpp"

namespace sediment::runner::slurm {

/// What an element asks Slurm for.
struct Request {
  Amounts amounts;
  std::uint64_t time_s = 0;  ///< 0 = what the partition has
  Profile::Options options;

  friend auto operator<=>(const Request&, const Request&) = default;
};

/// What one stage takes: as it declares, else as the profile says, else one cpu. With every `attempt` that
/// failed before twice the memory, as far as the stage's retries go.
Request request_of(const PlannedStage& stage, const Profile& profile, int attempt);

/// Adds a stage that runs in the same element: the most of every amount, the sum of the times. Throws
/// contract::UsageError if the profile has other options for it.
void add(Request& request, const Request& stage, const std::string& name);

/// As flags of sbatch.
std::vector<std::string> flags_of(const Request& request);

}  // namespace sediment::runner::slurm
