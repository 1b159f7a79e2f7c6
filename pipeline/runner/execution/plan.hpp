#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/runner/execution/instance.hpp"
#include "pipeline/runner/execution/workspace.hpp"
#include "pipeline/runner/store/key.hpp"
#include "pipeline/runner/store/store.hpp"

namespace sediment::runner {

/// Why a stage has to run.
struct Reason {
  std::string text;                     ///< in a few words
  std::vector<Difference> differences;  ///< against the last result of the same instance
};

/// Compares a key that is not in the store with what the stage last had, if it had anything.
Reason reason_for(const Key& key, const StageRecord* last, const Store& store);

/// What a run would do with a stage.
struct PlannedTask {
  enum class State { kept, runs, behind, skipped };
  State state = State::skipped;
  std::optional<Key> key;  ///< unknown while a stage before it has to run
  std::optional<Hit> hit;
  Reason why;
  std::vector<std::string> argv;  ///< of those that run; results that are not there yet as OUT/<stage>
};

/// What a run would do, by index of the stage. Executes nothing.
std::vector<PlannedTask> plan(const Instance& instance, Store& store, int threads);

/// The content ids of the inputs of a stage, given the result of each stage; nothing while one is missing.
std::optional<std::vector<std::string>> input_ids(const Instance& instance, std::size_t stage_idx,
                                                  const std::vector<std::string>& objects);

/// The paths of its inputs.
std::vector<std::filesystem::path> input_paths(const Instance& instance, std::size_t stage_idx,
                                               const std::vector<std::string>& objects, const Store& store);

}  // namespace sediment::runner
