#pragma once

#include "pipeline/runner/config/graph.hpp"

namespace sediment::runner {

/// The stages of the file in its order, with their inputs and canonical parameters.
std::vector<PlannedStage> resolve_stages(const PipelineFile& pipeline, const std::vector<Setting>& settings,
                                         const std::vector<Source>& sources, Programs& programs,
                                         Violations& violations);

}  // namespace sediment::runner
