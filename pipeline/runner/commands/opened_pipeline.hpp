#pragma once

#include <filesystem>

#include "pipeline/runner/commands/arguments.hpp"
#include "pipeline/runner/execution/instance.hpp"
#include "pipeline/runner/store/store.hpp"

namespace sediment::runner {

/// Where the results of a call go.
struct Places {
  std::filesystem::path out;  ///< absolute
  std::filesystem::path store;
};

Places places_of(const Arguments& arguments, const std::string& pipeline_name);

/// The store of a call that may name no pipeline. Throws contract::UsageError if nothing says where it is.
std::filesystem::path store_of(const Arguments& arguments);

/// A pipeline that was read, checked against its stages, and whose sources were digested.
struct OpenedPipeline {
  std::filesystem::path file;
  std::shared_ptr<Store> store;
  Instance instance;
};

/// Throws contract::UsageError with all that is wrong. Makes no folder and runs no stage (except for
/// --describe).
OpenedPipeline open_pipeline(const Arguments& arguments);

}  // namespace sediment::runner
