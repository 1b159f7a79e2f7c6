#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/runner/commands/opened_pipeline.hpp"
#include "pipeline/runner/execution/plan.hpp"
#include "pipeline/runner/execution/workspace.hpp"

namespace sediment::runner {

/// A pipeline with what a run would do and what the last run has done: all that the planning commands show.
struct Look {
  OpenedPipeline opened;
  std::vector<PlannedTask> tasks;
  std::map<std::string, StageRecord> last;

  const PlannedStage& stage(std::size_t idx) const { return opened.instance.graph->stages[idx]; }
  const StageRecord* last_of(std::size_t idx) const;
};

Look look(const Arguments& arguments);

/// "kept", "runs", "may run", "skipped".
const char* name_of(PlannedTask::State state);

/// A call as a shell takes it.
std::string shell_text(const std::vector<std::string>& argv);

}  // namespace sediment::runner
