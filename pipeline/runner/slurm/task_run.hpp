#pragma once

#include <filesystem>

namespace sediment::runner::slurm {

/// What the batch script of an array job executes on the machine that Slurm gave it: one task, with the local
/// executor on the shared store. Leaves how every work ended. Returns the exit code.
int run_task(const std::filesystem::path& submission, std::size_t array, std::size_t index);

}  // namespace sediment::runner::slurm
