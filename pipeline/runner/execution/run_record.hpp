#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/runner/execution/task.hpp"

namespace sediment::runner {

/// What a run leaves in the store: FOLDER/run.json (every stage that did not just stay: why, how long, how
/// large, what went wrong) and FOLDER/trace.json (the same as a time line, for chrome://tracing or
/// ui.perfetto.dev).
void write_run(const std::filesystem::path& folder, const std::vector<Task>& tasks, double seconds);

/// Brings run.json of every instance up to date (workspace.hpp). Of a stage that failed the last good result
/// stays known, so that a later difference can be explained. `run`: the folder above, empty if nothing ran.
void record(const std::vector<Instance>& instances, const std::vector<Task>& tasks, const std::string& run);

}  // namespace sediment::runner
