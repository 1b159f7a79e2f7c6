#pragma once

#include <map>
#include <string>
#include <utility>

#include "pipeline/runner/commands/look.hpp"

namespace sediment::runner {

/// What `status` shows of stages once something was submitted to Slurm from the same store.
struct SlurmStates {
  struct One {
    std::string state;  ///< "pending (Resources)"
    std::string why, job;
  };
  std::map<std::pair<std::size_t, std::size_t>, One> by_place;  ///< by instance and stage
  std::string summary;                                          ///< a line for the end; empty without Slurm
};

/// Empty if nothing was submitted. Does not throw if Slurm does not answer.
SlurmStates slurm_states(const Look& look);

}  // namespace sediment::runner
