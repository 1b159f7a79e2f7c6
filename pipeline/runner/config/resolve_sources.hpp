#pragma once

#include "pipeline/runner/config/graph.hpp"

namespace sediment::runner {

/// The sources with their values from `--set`, else from the file with its variables. A path of `--set` or of
/// a variable is relative to the current folder, one written in the file to the folder of the file.
std::vector<Source> resolve_sources(const PipelineFile& pipeline, const std::vector<Setting>& settings,
                                    Violations& violations);

/// Reports settings that name no source and no parameter.
void check_source_settings(const PipelineFile& pipeline, const std::vector<Setting>& settings,
                           Violations& violations);

}  // namespace sediment::runner
