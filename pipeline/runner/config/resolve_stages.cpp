#include "pipeline/runner/config/resolve_stages.hpp"

#include <algorithm>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/variables.hpp"

namespace sediment::runner {
namespace {

using contract::Json;
using contract::Parameter;
using contract::Port;

/// All that is known while one pipeline is resolved.
struct Resolution {
  const PipelineFile& pipeline;
  const std::vector<Setting>& settings;
  const std::vector<Source>& sources;
  Violations& violations;
  std::vector<PlannedStage> stages;

  int stage_idx(const std::string& name) const {
    const auto found =
        std::find_if(stages.begin(), stages.end(), [&](const auto& one) { return one.name == name; });
    return found == stages.end() ? -1 : static_cast<int>(found - stages.begin());
  }
  int source_idx(const std::string& name) const {
    const auto found =
        std::find_if(sources.begin(), sources.end(), [&](const auto& one) { return one.name == name; });
    return found == sources.end() ? -1 : static_cast<int>(found - sources.begin());
  }
  /// All that an input can be read from.
  std::vector<std::string> producers() const {
    std::vector<std::string> names;
    for (const Source& source : sources) names.push_back(source.name);
    for (const PlannedStage& stage : stages)
      if (stage.program)
        for (const Port& port : stage.program->description.writes)
          names.push_back(stage.name + '.' + port.role);
    return names;
  }
};

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all, std::string Named::*name) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.*name);
  return names;
}

/// Kind of what `from` names, and where it is; an empty kind if there is no such thing.
std::string find_producer(const Resolution& all, const std::string& from, Input& input) {
  const std::size_t dot = from.find('.');
  if (dot == std::string::npos) {
    input.source_idx = all.source_idx(from);
    return input.source_idx < 0 ? "" : all.sources[static_cast<std::size_t>(input.source_idx)].kind;
  }
  input.stage_idx = all.stage_idx(from.substr(0, dot));
  if (input.stage_idx < 0) return "";
  const auto& program = all.stages[static_cast<std::size_t>(input.stage_idx)].program;
  const Port* port = program ? program->description.find_output(from.substr(dot + 1)) : nullptr;
  return port == nullptr ? "" : port->kind;
}

void resolve_read(Resolution& all, const ReadEntry& read, const Port& port, PlannedStage& stage) {
  const std::string what = "stage " + stage.name + ": " + read.role;
  Input input{read.role};
  const std::string kind = find_producer(all, read.from, input);
  if (kind.empty()) {
    // A producer that is itself unknown has been reported on its own line.
    if (input.stage_idx >= 0 && !all.stages[static_cast<std::size_t>(input.stage_idx)].program) return;
    all.violations.add(read.line, what + ": nothing is called \"" + read.from + "\"" +
                                      did_you_mean(read.from, all.producers()));
    return;
  }
  if (port.kind != contract::kind::kFile && port.kind != kind)
    all.violations.add(read.line, what + ": expected " + port.kind + ", but " + read.from + " is " + kind);
  if (input.source_idx >= 0) {
    const auto entry = static_cast<std::size_t>(input.source_idx);
    if (all.pipeline.sources[entry].optional && !port.optional)
      all.violations.add(read.line, what + ": is required, but the source " + read.from + " is optional");
    if (all.sources[entry].path.empty()) return;  // optional and not given: the read is dropped
  }
  stage.inputs.push_back(input);
}

void resolve_reads(Resolution& all, const StageEntry& entry, PlannedStage& stage) {
  const auto& ports = stage.program->description.reads;
  const auto roles = names_of(ports, &Port::role);
  for (const ReadEntry& read : entry.reads)
    if (std::find(roles.begin(), roles.end(), read.role) == roles.end())
      all.violations.add(read.line, "stage " + entry.name + ": unknown role \"" + read.role + "\"" +
                                        did_you_mean(read.role, roles));
  for (const Port& port : ports) {
    const auto read = std::find_if(entry.reads.begin(), entry.reads.end(),
                                   [&](const ReadEntry& one) { return one.role == port.role; });
    if (read != entry.reads.end())
      resolve_read(all, *read, port, stage);
    else if (!port.optional)
      all.violations.add(entry.line, "stage " + entry.name + ": reads nothing as \"" + port.role + "\" (" +
                                         port.kind + ": " + port.help + ")");
  }
}

/// The value as written, in the parameter's type. Throws contract::UsageError.
Json value_of(const Parameter& parameter, Json written, std::vector<std::string>& unset) {
  const auto expanded = [&](const Json& text) {
    const Expansion expansion = expand(text.get<std::string>(), environment);
    unset.insert(unset.end(), expansion.unset.begin(), expansion.unset.end());
    return expansion.text;
  };
  if (written.is_string()) {
    const std::string text = expanded(written);
    return unset.empty() ? parse(parameter, text) : Json();
  }
  for (Json& item : written) item = expanded(item);
  return canonical(parameter, written);
}

void resolve_params(Resolution& all, const StageEntry& entry, PlannedStage& stage) {
  const auto& parameters = stage.program->description.parameters;
  const auto names = names_of(parameters, &Parameter::name);
  for (const Parameter& parameter : parameters) stage.params[parameter.name] = parameter.default_value;
  const auto assign = [&](const std::string& name, const Json& written, const auto& report) {
    const Parameter* parameter = stage.program->description.find_parameter(name);
    if (parameter == nullptr) return report("unknown parameter \"" + name + "\"" + did_you_mean(name, names));
    try {
      std::vector<std::string> unset;
      stage.params[name] = value_of(*parameter, written, unset);
      for (const std::string& variable : unset) report(name + ": ${" + variable + "} is not set");
    } catch (const contract::UsageError& error) {
      report(error.what());
    }
  };
  for (const ParameterEntry& one : entry.params)
    assign(one.name, one.value, [&](const std::string& text) {
      all.violations.add(one.line, "stage " + entry.name + ": " + text);
    });
  for (const Setting& setting : all.settings)
    if (setting.name.starts_with(entry.name + '.'))
      assign(setting.name.substr(entry.name.size() + 1), setting.value,
             [&](const std::string& text) { all.violations.add_call(setting.text() + ": " + text); });
}

void check_settings(Resolution& all) {
  const auto names = names_of(all.pipeline.stages, &StageEntry::name);
  for (const Setting& setting : all.settings) {
    const std::size_t dot = setting.name.find('.');
    const std::string stage = setting.name.substr(0, dot);
    if (dot != std::string::npos && std::find(names.begin(), names.end(), stage) == names.end())
      all.violations.add_call(setting.text() + ": unknown stage \"" + stage + "\"" +
                              did_you_mean(stage, names));
  }
}

}  // namespace

std::vector<PlannedStage> resolve_stages(const PipelineFile& pipeline, const std::vector<Setting>& settings,
                                         const std::vector<Source>& sources, Programs& programs,
                                         Violations& violations) {
  Resolution all{pipeline, settings, sources, violations, {}};
  for (const StageEntry& entry : pipeline.stages) {
    PlannedStage stage{entry.name, nullptr, "", {}, entry.resources, Json::object()};
    try {
      stage.program = programs.find(entry.name);
      stage.exe =
          pipeline.by_version ? "version " + stage.program->description.version : stage.program->digest;
    } catch (const contract::UsageError& error) {
      violations.add(entry.line, error.what());
    }
    all.stages.push_back(std::move(stage));
  }
  check_settings(all);
  for (std::size_t i = 0; i < pipeline.stages.size(); ++i) {
    if (!all.stages[i].program) continue;
    resolve_reads(all, pipeline.stages[i], all.stages[i]);
    resolve_params(all, pipeline.stages[i], all.stages[i]);
  }
  return std::move(all.stages);
}

}  // namespace sediment::runner
