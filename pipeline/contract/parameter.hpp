#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sediment::contract {

using Json = nlohmann::json;

/// Type of a parameter's value. `list` is a list of strings, on the command line separated by commas.
enum class ParameterType { boolean, integer, number, text, choice, list };

/// Inclusive bounds of a numeric parameter.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// The declaration of one parameter: flag, help, YAML check and cache key all come from it.
struct Parameter {
  std::string name;  ///< snake_case; the flag is --kebab-case
  ParameterType type = ParameterType::number;
  Json default_value;
  Range range{};
  std::vector<std::string> choices;  ///< of a choice
  std::string help;                  ///< meaning, unit, source
  bool affects_result = true;        ///< false: not part of the cache key (threads, log level)
};

std::string_view name_of(ParameterType type);

/// The value in its canonical type (an integer given for a number becomes a number; -0 becomes 0), or throws
/// UsageError "expected ..., found ..." if type, range or choice do not fit. NaN is never accepted.
Json canonical(const Parameter& parameter, const Json& value);

/// Reads a value as written on a command line or after `--set name=`. Throws UsageError as canonical().
Json parse(const Parameter& parameter, std::string_view text);

}  // namespace sediment::contract
