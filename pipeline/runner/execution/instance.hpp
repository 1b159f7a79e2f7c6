#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/runner/config/graph.hpp"

namespace sediment::runner {

/// A pipeline over given sources, with a folder for its results.
struct Instance {
  std::string name;  ///< empty if it is the only one
  std::shared_ptr<const Graph> graph;
  std::filesystem::path out;
  std::vector<std::filesystem::path> source_paths;  ///< of each source of the graph, empty if it is not given
  std::vector<std::string> source_ids;  ///< content id of each source of the graph, empty if it is not given
  std::vector<bool> selected;  ///< stages that may be run; the others must be in the store where needed
  std::vector<bool> needed;    ///< selected ones and all they read from
};

/// Marks the stages between `from` and `until`, or `only` one; empty names do not limit.
void select_stages(Instance& instance, const std::string& only, const std::string& from,
                   const std::string& until);

}  // namespace sediment::runner
