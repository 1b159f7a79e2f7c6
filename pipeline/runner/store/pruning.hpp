#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pipeline/runner/store/store.hpp"

namespace sediment::runner {

/// What to remove from a store. At least one of the first three must be said.
struct PruningRules {
  std::optional<std::uint64_t> older_than_s;
  std::optional<std::uint64_t> max_bytes;
  std::optional<std::set<std::string>> keep;  ///< keys that named pipelines would use now
  bool dry_run = false;
};

struct Pruned {
  std::string stage, key, made;
  std::uint64_t bytes = 0;  ///< that its removal frees
};

/// Removes results that the rules name, oldest first; never what is pinned, linked from the folder of a run,
/// or being made at this moment. Records of runs and what was put aside as damaged go by their age alone.
/// Returns what was (or would be) removed.
std::vector<Pruned> prune(Store& store, const PruningRules& rules);

/// Keeps a result from being pruned, or no longer.
void set_pinned(const Store& store, const std::string& key, bool pinned);

/// Remembers a folder of results, so that what it links to is never pruned.
void remember_workspace(const Store& store, const std::filesystem::path& folder);

}  // namespace sediment::runner
