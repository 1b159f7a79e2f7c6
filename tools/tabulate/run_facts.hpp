#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sediment::tabulate {

/// What the receipt of a stage says.
struct StageFacts {
  std::string key;  ///< of the receipt
  std::filesystem::path folder;
  std::vector<std::string> kinds;  ///< of its outputs
  std::map<std::string, std::uint64_t> files;
  nlohmann::json params, metrics;
  double wall_s = 0;
  std::uint64_t peak_bytes = 0;

  /// As the runner shows it: "x3:" and eight digits.
  std::string short_key() const { return key.substr(0, 11); }
};

/// One instance of a sweep, or a run by itself.
struct InstanceFacts {
  std::string name;
  std::map<std::string, std::string> values;  ///< on the axes
  std::filesystem::path sequence;             ///< YAML; empty if no stage reads one
  std::vector<std::string> order;
  std::map<std::string, StageFacts> stages;

  /// The last stage with an output of that kind; nullptr if there is none.
  const StageFacts* last_with(const std::string& kind) const;
  /// Sum over all stages.
  double wall_s() const;
  std::uint64_t peak_bytes() const;
};

struct RunFacts {
  std::string name;
  std::vector<std::string> axes;  ///< in the order of the sweep
  std::vector<InstanceFacts> instances;
};

/// Reads what `sediment report FOLDER --facts FILE` wrote. Throws std::runtime_error that names the file.
RunFacts read_run_facts(const std::filesystem::path& file);

}  // namespace sediment::tabulate
