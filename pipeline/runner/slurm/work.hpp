#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/runner/execution/instance.hpp"
#include "pipeline/runner/store/store.hpp"

namespace sediment::runner::slurm {

/// A stage of an instance.
struct Place {
  std::size_t instance_idx, stage_idx;
};

/// A piece of work: a stage with its parameters on given sources, in however many instances it occurs.
struct Work {
  /// Digest of what it is made from: program, parameters and, through the works before it, sources. Unlike a
  /// key it is known before anything has run, and it stays the same when something has.
  std::string id;
  std::vector<Place> places;
  std::vector<std::size_t> reads;  ///< works before it, by their place in the list
  std::string key;                 ///< empty while a work before it has no result
  std::optional<Hit> hit;
  bool selected = false;  ///< may be run
};

/// The works of all instances, each once; those before a work stand before it.
std::vector<Work> works_of(const std::vector<Instance>& instances, Store& store);

/// "stage", or "instance/stage" of the first instance that has it.
std::string label_of(const Work& work, const std::vector<Instance>& instances);

/// The stage that does it, as its first instance has it.
const PlannedStage& stage_of(const Work& work, const std::vector<Instance>& instances);

}  // namespace sediment::runner::slurm
