#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/runner/commands/opened_config.hpp"
#include "pipeline/runner/execution/plan.hpp"
#include "pipeline/runner/execution/workspace.hpp"

namespace sediment::runner {

/// A stage of an instance: what a run would do with it and what the last run did.
struct LookedAt {
  std::string label;  ///< stage, or instance/stage
  std::size_t instance_idx = 0, stage_idx = 0;
  PlannedTask task;
  std::optional<StageRecord> last;
};

/// All that the planning commands show.
struct Look {
  OpenedConfig opened;
  std::vector<LookedAt> stages;  ///< those that are not left out by --only, --from, --until

  /// By its label; an empty one stands for all. Throws contract::UsageError naming the nearest one.
  std::vector<const LookedAt*> named(const std::string& label) const;
};

Look look(const Arguments& arguments);

/// "kept", "runs", "may run", "skipped".
const char* name_of(PlannedTask::State state);

/// A call as a shell takes it.
std::string shell_text(const std::vector<std::string>& argv);

}  // namespace sediment::runner
