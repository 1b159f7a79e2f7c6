#include "pipeline/runner/sweep/sweep_file.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <cmath>
#include <fstream>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/variables.hpp"
#include "pipeline/runner/config/yaml_mapping.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::UsageError;

constexpr std::size_t kMostValues = 100'000;

/// Everything that is known while a sweep is read.
struct Reading {
  SweepFile& sweep;
  Violations& violations;

  /// A value with its variables; a path that is written in the file is relative to the folder of the file.
  std::string value_of(const std::string& name, const YAML::Node& node) const {
    const Expansion expansion = expand(node.Scalar(), environment);
    for (const std::string& variable : expansion.unset)
      violations.add(line_of(node), name + ": ${" + variable + "} is not set");
    const bool is_source = name.find('.') == std::string::npos;
    if (!is_source || begins_with_variable(node.Scalar())) return expansion.text;
    return (fs::absolute(sweep.file).parent_path() / expansion.text).lexically_normal().string();
  }
};

std::vector<std::string> files_matching(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> files;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return files;
}

/// {from: 0.01, to: 0.05, step: 0.02}. Each value is computed from its index, so that no rounding error adds
/// up.
std::vector<std::string> values_in_range(const Reading& all, const std::string& name,
                                         const YAML::Node& node) {
  double from = 0, to = 0, step = 0;
  const auto number = [&](double& value) {
    return [&](const YAML::Node& key, const YAML::Node& given) {
      if (!YAML::convert<double>::decode(given, value) || !std::isfinite(value))
        all.violations.add(line_of(key), name + ": expected a number for \"" + key.Scalar() + '"');
    };
  };
  Mapping(name, all.violations)
      .key("from", number(from))
      .key("to", number(to))
      .key("step", number(step))
      .read(node, line_of(node));
  std::vector<std::string> values;
  const double count = step > 0 ? std::floor((to - from) / step + 1e-9) + 1 : 0;
  if (count < 1 || count > static_cast<double>(kMostValues)) {
    all.violations.add(line_of(node), name + ": expected {from: A, to: B, step: S} with A <= B and S > 0");
    return values;
  }
  for (int i = 0; i < static_cast<int>(count); ++i) values.push_back(fmt::format("{:.12g}", from + i * step));
  return values;
}

std::vector<std::string> values_of(const Reading& all, const std::string& name, const YAML::Node& node) {
  if (node.IsMap()) return values_in_range(all, name, node);
  std::vector<std::string> values;
  if (node.IsScalar() && node.Scalar().find_first_of("*?[") != std::string::npos) {
    values = files_matching(all.value_of(name, node));
    if (values.empty())
      all.violations.add(line_of(node), name + ": no file matches " + all.value_of(name, node));
  } else if (node.IsSequence()) {
    for (const auto& item : node) {
      if (item.IsScalar())
        values.push_back(all.value_of(name, item));
      else
        all.violations.add(line_of(item), name + ": expected a value");
    }
  }
  if (values.empty())
    all.violations.add(line_of(node),
                       name + ": expected a list, a range {from, to, step} or a pattern of files");
  return values;
}

void read_axis(const Reading& all, const YAML::Node& node) {
  Axis axis;
  axis.line = line_of(node);
  const auto read = [&](const YAML::Node& key, const YAML::Node& value) {
    const auto values = values_of(all, key.Scalar(), value);
    if (!axis.names.empty() && values.size() != axis.points.size())
      return all.violations.add(
          line_of(key), fmt::format("{} has {} values, but {}, which walks with it, has {}", key.Scalar(),
                                    values.size(), axis.names[0], axis.points.size()));
    axis.names.push_back(key.Scalar());
    axis.points.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) axis.points[i].push_back(values[i]);
  };
  Mapping("over", all.violations).any(read).read(node, axis.line);
  all.sweep.axes.push_back(std::move(axis));
}

}  // namespace

bool is_sweep(const fs::path& file) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("pipeline:")) return true;
  return false;
}

SweepFile read_sweep(const fs::path& file, Violations& violations) {
  SweepFile sweep;
  sweep.file = file;
  sweep.name = file.stem();
  Reading all{sweep, violations};
  const auto over = [&](const YAML::Node& key, const YAML::Node& value) {
    if (!value.IsSequence()) return violations.add(line_of(key), "over: expected a list of mappings");
    for (const auto& axis : value) read_axis(all, axis);
  };
  const auto set = [&](const YAML::Node& key, const YAML::Node& value) {
    if (!value.IsScalar()) return violations.add(line_of(key), key.Scalar() + ": expected a value");
    sweep.set.push_back({key.Scalar(), all.value_of(key.Scalar(), value),
                         file.string() + ':' + std::to_string(line_of(key)) + ": "});
  };
  std::string pipeline;
  Mapping("sweep", violations)
      .key("pipeline", text_into(pipeline, "sweep", violations))
      .key("over", over)
      .key("set",
           [&](const auto& k, const auto& v) { Mapping("set", violations).any(set).read(v, line_of(k)); })
      .read(load_yaml(file), 1);
  sweep.pipeline = pipeline_file_of(fs::absolute(file).parent_path() / pipeline);
  if (sweep.axes.empty()) violations.add(1, "the sweep varies nothing: \"over\" is missing or empty");
  return sweep;
}

}  // namespace sediment::runner
