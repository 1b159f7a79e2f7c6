#pragma once

#include <algorithm>
#include <concepts>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "pipeline/contract/description.hpp"
#include "pipeline/contract/errors.hpp"

namespace sediment::contract {

/// What the body of a stage is given: where its inputs are, where its files go, what it reports.
class Work {
 public:
  Work(std::map<std::string, std::filesystem::path> inputs, std::filesystem::path out, int threads)
      : inputs_(std::move(inputs)), out_(std::move(out)), threads_(threads) {}

  /// Path of an input by its role.
  const std::filesystem::path& in(const std::string& role) const { return inputs_.at(role); }
  /// Whether an optional input was given.
  bool has(const std::string& role) const { return inputs_.contains(role); }
  /// The folder to write into. It becomes the result when the body returns.
  const std::filesystem::path& out() const { return out_; }
  /// Threads the stage may use; TBB is limited to it already.
  int threads() const { return threads_; }
  /// Counts and measures for metrics.json. Never times: the same inputs must give the same bytes.
  Json& metrics() { return metrics_; }

 private:
  std::map<std::string, std::filesystem::path> inputs_;
  std::filesystem::path out_;
  int threads_;
  Json metrics_ = Json::object();
};

/// The name of each value of an enumeration, as a parameter takes it.
template <class Enum>
using Choices = std::vector<std::pair<std::string, Enum>>;

/// The declaration of a stage, and its execution. From the declaration come the flags, --help, --describe,
/// the check of the YAML and the cache key:
///
///     sor::Parameters parameters;                       // the defaults live in this struct
///     Stage stage("sor", "Statistical outlier removal");
///     stage.reads("cloud", kind::kCloud, "cloud to filter");
///     stage.writes("cloud", kind::kCloud, "cloud without outliers");
///     stage.tunes("neighbors", parameters.neighbors, "k of equation (9)", {1, 10000});
///     return stage.run(argc, argv, [&](Work& work) { ... });
class Stage {
 public:
  Stage(std::string name, std::string summary);

  void reads(std::string role, std::string kind, std::string help);
  void reads_optional(std::string role, std::string kind, std::string help);
  void writes(std::string role, std::string kind, std::string help);

  void tunes(std::string name, bool& value, std::string help);
  void tunes(std::string name, std::string& value, std::string help);
  void tunes(std::string name, std::vector<std::string>& value, std::string help);
  template <class Number>
  requires(std::is_arithmetic_v<Number> &&
           !std::same_as<Number, bool>) void tunes(std::string name, Number& value, std::string help,
                                                   Range range = {}) {
    constexpr auto type = std::is_integral_v<Number> ? ParameterType::integer : ParameterType::number;
    // A whole number must fit the variable it goes to.
    if constexpr (std::is_integral_v<Number>) {
      range.min = std::max(range.min, static_cast<double>(std::numeric_limits<Number>::min()));
      range.max = std::min(range.max, static_cast<double>(std::numeric_limits<Number>::max()));
    }
    add({std::move(name), type, Json(value), range, {}, std::move(help)},
        [&value](const Json& json) { value = json.get<Number>(); });
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void tunes(std::string name, Enum& value, std::string help, const Choices<Enum>& choices) {
    std::vector<std::string> names;
    Json chosen;
    for (const auto& [choice, meaning] : choices) {
      names.push_back(choice);
      if (meaning == value) chosen = choice;
    }
    add({std::move(name), ParameterType::choice, chosen, {}, names, std::move(help)},
        [&value, choices](const Json& json) {
          for (const auto& [choice, meaning] : choices)
            if (json == choice) value = meaning;
        });
  }

  const Description& description() const { return description_; }

  /// Parses the call, answers --help and --describe, checks the inputs, runs the body in `<out>.partial`,
  /// writes metrics.json and manifest.json and renames to `<out>`. An earlier result of ours at `<out>` is
  /// replaced; any other folder there is refused. Returns the exit code; reports errors on stderr.
  int run(int argc, char** argv, const std::function<void(Work&)>& body);

 private:
  void add(Parameter parameter, std::function<void(const Json&)> assign);

  Description description_;
  std::vector<std::function<void(const Json&)>> assign_;  ///< by index of description_.parameters
};

}  // namespace sediment::contract
