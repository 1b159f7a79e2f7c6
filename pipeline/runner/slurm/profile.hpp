#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/runner/config/resources.hpp"

namespace sediment::runner::slurm {

/// What one cluster wants to be told, apart from the pipeline: a YAML file.
struct Profile {
  using Options = std::vector<std::string>;  ///< of sbatch: "--partition=main"

  Options options;                        ///< of every job
  std::map<std::string, Options> stages;  ///< further ones of a stage
  Resources defaults;                     ///< of stages that declare nothing of a kind
  int in_flight = 0;                      ///< elements that run at the same time; 0 = no limit
};

/// Throws contract::UsageError with all that is wrong.
Profile read_profile(const std::filesystem::path& file);

}  // namespace sediment::runner::slurm
