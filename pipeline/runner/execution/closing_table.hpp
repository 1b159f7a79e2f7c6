#pragma once

#include <string>
#include <vector>

#include "pipeline/runner/execution/task.hpp"

namespace sediment::runner {

/// What a run did: a row per stage, or with many instances a row per stage of all of them; then one line in
/// all.
std::string closing_table(const std::vector<Task>& tasks, double seconds);

}  // namespace sediment::runner
