#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "pipeline/runner/store/store.hpp"

namespace sediment::runner {

/// What is known of a stage after a run.
struct StageRecord {
  std::string key;  ///< empty if it failed or did not run
  std::string object;
  std::string state;  ///< kept, ran, failed, blocked, not run
  std::string why;    ///< why it last ran
  std::string log;    ///< file with what a failed stage said
  double wall_s = 0;
  std::uint64_t bytes = 0, peak_bytes = 0;
  friend bool operator==(const StageRecord&, const StageRecord&) = default;
};

/// The folder that `--out` names: a link to the result of each stage, and run.json, the record of its last
/// run.
class Workspace {
 public:
  explicit Workspace(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Throws contract::UsageError if something that is no link stands where the link of a stage must go.
  void check(const std::string& stage) const;
  /// FOLDER/<stage> -> the result. Relative if the store lies in the folder, so that both can be moved
  /// together.
  void link(const std::string& stage, const std::string& object, const Store& store) const;

  std::map<std::string, StageRecord> read_record() const;
  /// Writes run.json unless the keys in it are the same already and nothing ran.
  void write_record(const std::map<std::string, StageRecord>& stages) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace sediment::runner
