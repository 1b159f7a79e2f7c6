#include "pipeline/runner/config/pipeline_file.hpp"

#include <algorithm>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/yaml_mapping.hpp"

namespace sediment::runner {
namespace {

namespace fs = std::filesystem;
using contract::Json;
using contract::UsageError;

SourceEntry read_source(const YAML::Node& key, const YAML::Node& value, Violations& violations) {
  SourceEntry source{key.Scalar(), "", "", false, line_of(key)};
  const std::string what = "source " + source.name;
  Mapping(what, violations)
      .key("kind", text_into(source.kind, what, violations))
      .key("path", text_into(source.path, what, violations))
      .key("optional",
           [&](const YAML::Node& name, const YAML::Node& flag) {
             if (!YAML::convert<bool>::decode(flag, source.optional))
               violations.add(line_of(name), what + ": expected true or false for \"optional\"");
           })
      .read(value, source.line);
  if (source.kind.empty()) violations.add(source.line, what + ": \"kind\" is missing");
  if (source.path.empty()) violations.add(source.line, what + ": \"path\" is missing");
  return source;
}

ParameterEntry read_parameter(const YAML::Node& key, const YAML::Node& value, const std::string& stage,
                              Violations& violations) {
  ParameterEntry parameter{key.Scalar(), Json(), line_of(key)};
  const auto is_text = [](const YAML::Node& item) { return item.IsScalar(); };
  if (value.IsScalar()) {
    parameter.value = value.Scalar();
  } else if (value.IsSequence() && std::all_of(value.begin(), value.end(), is_text)) {
    parameter.value = Json::array();
    for (const auto& item : value) parameter.value.push_back(item.Scalar());
  } else {
    violations.add(parameter.line, "stage " + stage + ": " + parameter.name + ": expected a value or a list");
  }
  return parameter;
}

StageEntry read_stage(const YAML::Node& key, const YAML::Node& value, Violations& violations) {
  StageEntry stage{key.Scalar(), {}, {}, {}, line_of(key)};
  const std::string what = "stage " + stage.name;
  const auto read_role = [&](const YAML::Node& role, const YAML::Node& from) {
    ReadEntry read{role.Scalar(), "", line_of(role)};
    text_into(read.from, what, violations)(role, from);
    stage.reads.push_back(read);
  };
  const auto read_param = [&](const YAML::Node& name, const YAML::Node& item) {
    stage.params.push_back(read_parameter(name, item, stage.name, violations));
    if (stage.params.back().value.is_null()) stage.params.pop_back();
  };
  const auto read_resource = [&](const YAML::Node& name, const YAML::Node& amount) {
    std::string text;
    text_into(text, what, violations)(name, amount);
    try {
      if (name.Scalar() == "time")
        stage.resources.time_s = seconds_from(text);
      else
        stage.resources.amounts[name.Scalar()] = amount_from(name.Scalar(), text);
    } catch (const UsageError& error) {
      violations.add(line_of(name), what + ": " + error.what());
    }
  };
  Mapping(what, violations)
      .key("reads",
           [&](const auto& k, const auto& v) {
             Mapping(what + " reads", violations).any(read_role).read(v, line_of(k));
           })
      .key("params",
           [&](const auto& k, const auto& v) {
             Mapping(what + " params", violations).any(read_param).read(v, line_of(k));
           })
      .key("resources",
           [&](const auto& k, const auto& v) {
             Mapping(what + " resources", violations).any(read_resource).read(v, line_of(k));
           })
      .key("retries",
           [&](const auto& k, const auto& v) {
             if (!YAML::convert<int>::decode(v, stage.resources.retries) || stage.resources.retries < 0)
               violations.add(line_of(k), what + ": expected a whole number for \"retries\"");
           })
      .read(value, stage.line);
  return stage;
}

}  // namespace

fs::path pipeline_file_of(const fs::path& config) {
  return fs::is_directory(config) ? config / "pipeline.yaml" : config;
}

PipelineFile read_pipeline(const fs::path& file, Violations& violations) {
  PipelineFile pipeline;
  pipeline.file = file;
  pipeline.name =
      (file.filename() == "pipeline.yaml" ? fs::absolute(file).lexically_normal().parent_path() : file)
          .stem()
          .string();
  const auto sources = [&](const YAML::Node& key, const YAML::Node& value) {
    Mapping("sources", violations)
        .any([&](const auto& k, const auto& v) { pipeline.sources.push_back(read_source(k, v, violations)); })
        .read(value, line_of(key));
  };
  const auto stages = [&](const YAML::Node& key, const YAML::Node& value) {
    Mapping("stages", violations)
        .any([&](const auto& k, const auto& v) { pipeline.stages.push_back(read_stage(k, v, violations)); })
        .read(value, line_of(key));
  };
  const auto fingerprint = [&](const YAML::Node& key, const YAML::Node& value) {
    std::string text;
    text_into(text, "pipeline", violations)(key, value);
    pipeline.by_version = text == "version";
    if (text != "version" && text != "content")
      violations.add(line_of(key), "fingerprint: expected content or version, found \"" + text + '"');
  };
  Mapping("pipeline", violations)
      .key("fingerprint", fingerprint)
      .key("sources", sources)
      .key("stages", stages)
      .read(load_yaml(file), 1);
  if (pipeline.stages.empty()) violations.add(1, "the pipeline has no stages");
  return pipeline;
}

}  // namespace sediment::runner
