#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/runner/store/store.hpp"

namespace sediment::runner {

/// What is known of a stage after a run.
struct StageRecord {
  std::string key;  ///< of its last good result; empty if there was none
  std::string object;
  std::string state;  ///< kept, ran, failed, blocked, interrupted, not run
  std::string why;    ///< why it last ran, or what went wrong
  std::string log;    ///< file with what a failed stage said
  double wall_s = 0;
  std::uint64_t bytes = 0, peak_bytes = 0;
};

/// run.json: the last run of an instance.
struct RunRecord {
  std::string id;                  ///< digest of keys and states: tells whether anything is new
  std::string run;                 ///< folder of the last run that did something
  std::vector<std::string> order;  ///< the stages as the pipeline has them
  std::map<std::string, StageRecord> stages;
};

/// The folder of an instance's results: a link to the result of each stage, and run.json.
class Workspace {
 public:
  explicit Workspace(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws contract::UsageError if something that is no link stands where the link of a stage must go.
  void check(const std::string& stage) const;
  /// FOLDER/<stage> -> the result. Relative if the folder lies where the store does, so that both can be
  /// moved together. Throws as check().
  void link(const std::string& stage, const std::string& object, const Store& store) const;

  /// Empty if there is none that can be read: the record explains, nothing depends on it.
  RunRecord read_record() const;
  /// The id in run.json, read without the rest.
  std::string recorded() const;
  void write_record(const RunRecord& record) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace sediment::runner
