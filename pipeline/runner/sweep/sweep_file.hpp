#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/runner/config/graph.hpp"
#include "pipeline/runner/config/violations.hpp"

namespace sediment::runner {

/// One direction of a sweep: one name with its values, or several names that walk together.
struct Axis {
  std::vector<std::string> names;                ///< sources and stage.parameters
  std::vector<std::vector<std::string>> points;  ///< at each point a value per name
  int line = 0;
};

/// A sweep as it is written: a pipeline, and what is varied over it.
struct SweepFile {
  std::filesystem::path file;
  std::string name;  ///< of the file
  std::filesystem::path pipeline;
  std::vector<Setting> set;  ///< the same for all
  std::vector<Axis> axes;
};

/// Whether a configuration is a sweep: it names a pipeline instead of being one.
bool is_sweep(const std::filesystem::path& file);

/// What is wrong goes to `violations`. Throws contract::UsageError if the file is no YAML.
SweepFile read_sweep(const std::filesystem::path& file, Violations& violations);

}  // namespace sediment::runner
