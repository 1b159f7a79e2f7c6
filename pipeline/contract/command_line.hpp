#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "pipeline/contract/description.hpp"

namespace sediment::contract {

/// A call of a stage, understood.
struct Call {
  std::map<std::string, std::filesystem::path> inputs;  ///< by role; optional ones only if given
  std::filesystem::path out;
  int threads = 0;                     ///< 0 = all cores
  std::map<std::string, Json> values;  ///< of the parameters that were given, canonical
};

/// Parses the call of a stage by its description. Answers --help, --describe and --version itself on stdout:
/// then there is no call to carry out. Throws UsageError.
std::optional<Call> parse_call(const Description& description, int argc, char** argv);

}  // namespace sediment::contract
