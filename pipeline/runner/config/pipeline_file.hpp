#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/contract/parameter.hpp"
#include "pipeline/runner/config/resources.hpp"
#include "pipeline/runner/config/violations.hpp"

namespace sediment::runner {

/// A pipeline as it is written: names and texts with their lines, nothing resolved.
struct SourceEntry {
  std::string name;
  std::string kind;
  std::string path;  ///< with marked variables
  bool optional = false;
  int line = 0;
};

struct ReadEntry {
  std::string role;
  std::string from;  ///< "source" or "stage.role"
  int line = 0;
};

struct ParameterEntry {
  std::string name;
  contract::Json value;  ///< a text, or a list of texts; with marked variables
  int line = 0;
};

struct StageEntry {
  std::string name;
  std::vector<ReadEntry> reads;
  std::vector<ParameterEntry> params;
  Resources resources;
  int line = 0;
};

struct PipelineFile {
  std::filesystem::path file;
  std::string name;         ///< of its folder if it is called pipeline.yaml, else of the file
  bool by_version = false;  ///< `fingerprint: version`: a program is known by its version, not by its bytes
  std::vector<SourceEntry> sources;
  std::vector<StageEntry> stages;
};

/// Reads a pipeline; a folder stands for the pipeline.yaml in it. What is wrong with its keys and shapes goes
/// to `violations`. Throws contract::UsageError if the file cannot be read or is no YAML.
PipelineFile read_pipeline(const std::filesystem::path& file, Violations& violations);

/// The file that `config` stands for.
std::filesystem::path pipeline_file_of(const std::filesystem::path& config);

}  // namespace sediment::runner
