#include "pipeline/runner/slurm/profile.hpp"

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/variables.hpp"
#include "pipeline/runner/config/yaml_mapping.hpp"

namespace sediment::runner::slurm {
namespace {

using Options = Profile::Options;

/// Flags of sbatch that have a key of their own; all others go through "options".
constexpr const char* kNamed[] = {"partition", "account", "qos", "constraint", "reservation", "exclude"};

std::string value_of(const YAML::Node& key, const YAML::Node& value, Violations& violations) {
  if (!value.IsScalar()) {
    violations.add(line_of(key), key.Scalar() + ": expected a value");
    return "";
  }
  const Expansion expansion = expand(value.Scalar(), environment);
  for (const std::string& variable : expansion.unset)
    violations.add(line_of(value), key.Scalar() + ": ${" + variable + "} is not set");
  return expansion.text;
}

void read_free_options(const YAML::Node& key, const YAML::Node& list, Options& options,
                       Violations& violations) {
  if (!list.IsSequence()) return violations.add(line_of(key), "options: expected a list of flags of sbatch");
  for (const auto& item : list) {
    const std::string flag = value_of(key, item, violations);
    // One word: it becomes a line of the batch script.
    if (!flag.starts_with("--") || flag.find_first_of("\n\r") != std::string::npos)
      violations.add(line_of(item), "options: expected a flag like --exclude=node7, found \"" + flag + '"');
    options.push_back(flag);
  }
}

/// Adds the readers of the flags to a mapping.
Mapping& with_options(Mapping& mapping, Options& options, Violations& violations) {
  for (const char* name : kNamed)
    mapping.key(name, [&, name](const YAML::Node& key, const YAML::Node& value) {
      options.push_back(std::string("--") + name + '=' + value_of(key, value, violations));
    });
  return mapping.key("options", [&](const YAML::Node& key, const YAML::Node& list) {
    read_free_options(key, list, options, violations);
  });
}

void read_default(const YAML::Node& key, const YAML::Node& value, Resources& defaults,
                  Violations& violations) {
  const std::string name = key.Scalar(), text = value_of(key, value, violations);
  try {
    if (name == "time")
      defaults.time_s = seconds_from(text);
    else
      defaults.amounts[name] = amount_from(name, text);
  } catch (const contract::UsageError& error) {
    violations.add(line_of(key), std::string("defaults: ") + error.what());
  }
}

}  // namespace

Profile read_profile(const std::filesystem::path& file) {
  Profile profile;
  Violations violations(file);
  const auto stage = [&](const YAML::Node& key, const YAML::Node& value) {
    Mapping mapping("stage " + key.Scalar(), violations);
    with_options(mapping, profile.stages[key.Scalar()], violations).read(value, line_of(key));
  };
  const auto in_flight = [&](const YAML::Node& key, const YAML::Node& value) {
    if (!YAML::convert<int>::decode(value, profile.in_flight) || profile.in_flight < 1)
      violations.add(line_of(key), "in_flight: expected a number of at least 1");
  };
  Mapping mapping("profile", violations);
  with_options(mapping, profile.options, violations)
      .key("in_flight", in_flight)
      .key("stages", [&](const auto& k,
                         const auto& v) { Mapping("stages", violations).any(stage).read(v, line_of(k)); })
      .key("defaults",
           [&](const auto& k, const auto& v) {
             Mapping("defaults", violations)
                 .any([&](const auto& key, const auto& value) {
                   read_default(key, value, profile.defaults, violations);
                 })
                 .read(v, line_of(k));
           })
      .read(load_yaml(file), 1);
  violations.throw_if_any();
  return profile;
}

}  // namespace sediment::runner::slurm
