#pragma once

#include "pipeline/runner/commands/arguments.hpp"
#include "pipeline/runner/slurm/submitting.hpp"

namespace sediment::runner {

/// What a call with --backend slurm asks for. Throws contract::UsageError.
slurm::Setup slurm_setup_of(const Arguments& arguments);

}  // namespace sediment::runner
