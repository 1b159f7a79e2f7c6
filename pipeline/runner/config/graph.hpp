#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pipeline/runner/config/pipeline_file.hpp"
#include "pipeline/runner/config/program.hpp"
#include "pipeline/runner/config/resources.hpp"

namespace sediment::runner {

/// What was said on the command line about sources and parameters: `--set sequence=PATH`, `--set
/// sor.neighbors=30`.
struct Setting {
  std::string name;  ///< "source" or "stage.parameter"
  std::string value;
  std::string said;  ///< where, for what is wrong with it: "--set ", "sweep.yaml:7: "

  /// "--set sor.neighbors=30".
  std::string text() const { return said + name + '=' + value; }
};

/// A source with its value: the path a stage is given.
struct Source {
  std::string name;
  std::string kind;
  std::filesystem::path path;  ///< empty: optional and not given
};

/// Where an input of a stage comes from: a source or an earlier stage.
struct Input {
  std::string role;
  int source_idx = -1;
  int stage_idx = -1;
};

/// A stage, checked against its description.
struct PlannedStage {
  std::string name;
  std::shared_ptr<const Program> program;
  std::string exe;  ///< what the program is known by: the digest of its bytes, or its version
  std::vector<Input>
      inputs;  ///< in the order of the declaration; optional ones that are not given are left out
  Resources resources;
  contract::Json params;  ///< every parameter, canonical: defaults overlaid by the YAML and --set
};

/// The checked pipeline. Every stage stands behind those it reads from; otherwise the order is the file's.
struct Graph {
  std::vector<Source> sources;
  std::vector<PlannedStage> stages;

  /// Index of a stage. Throws contract::UsageError naming the nearest one.
  int index_of(const std::string& stage) const;
  /// Whether `stage_idx` reads, directly or through others, from `from_idx`.
  bool is_behind(int stage_idx, int from_idx) const;
};

/// Splits "name=value". Throws contract::UsageError.
Setting setting_from(const std::string& text);

/// Checks the pipeline against the description of every stage: names, types, ranges, kinds, roles, cycles.
/// What is wrong goes to `violations`; the graph may only be used if there is none.
/// The sources are resolved already (resolve_sources.hpp).
Graph resolve(const PipelineFile& pipeline, const std::vector<Setting>& settings, std::vector<Source> sources,
              Programs& programs, Violations& violations);

}  // namespace sediment::runner
