#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "pipeline/runner/commands/arguments.hpp"
#include "pipeline/runner/execution/instance.hpp"
#include "pipeline/runner/store/store.hpp"
#include "pipeline/runner/sweep/sweep_points.hpp"

namespace sediment::runner {

/// The store of a call that may name no configuration. Throws contract::UsageError if nothing says where it
/// is.
std::filesystem::path store_of(const Arguments& arguments);

/// The folder of results of a call that names a configuration, absolute.
std::filesystem::path out_of(const Arguments& arguments);

/// A pipeline, or all instances of a sweep: read, checked against the stages, and the sources digested.
struct OpenedConfig {
  std::filesystem::path out;  ///< absolute
  std::shared_ptr<Store> store;
  std::vector<Instance> instances;
  std::vector<SweepPoint> points;  ///< of a sweep, in the order of the instances
};

/// Throws contract::UsageError with all that is wrong. Makes no folder and runs no stage (except for
/// --describe).
OpenedConfig open_config(const Arguments& arguments);

}  // namespace sediment::runner
