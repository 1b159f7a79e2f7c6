#include "pipeline/runner/slurm/frozen_graph.hpp"

#include "pipeline/contract/description.hpp"

namespace sediment::runner::slurm {

using contract::Json;

Json to_json(const FrozenPrograms& programs) {
  Json json = Json::object();
  for (const auto& [name, program] : programs)
    json[name] = {{"path", program->path.string()},
                  {"digest", program->digest},
                  {"description", contract::to_json(program->description)}};
  return json;
}

FrozenPrograms programs_from(const Json& json) {
  FrozenPrograms programs;
  for (const auto& [name, one] : json.items())
    programs[name] =
        std::make_shared<const Program>(Program{one.at("path").get<std::string>(), one.at("digest"),
                                                contract::description_from(one.at("description"))});
  return programs;
}

Json to_json(const Graph& graph) {
  Json sources = Json::array(), stages = Json::array();
  for (const Source& source : graph.sources)
    sources.push_back({{"name", source.name}, {"kind", source.kind}, {"path", source.path.string()}});
  for (const PlannedStage& stage : graph.stages) {
    Json inputs = Json::array();
    for (const Input& input : stage.inputs)
      inputs.push_back({{"role", input.role}, {"source", input.source_idx}, {"stage", input.stage_idx}});
    stages.push_back({{"name", stage.name},
                      {"exe", stage.exe},
                      {"inputs", inputs},
                      {"amounts", stage.resources.amounts},
                      {"params", stage.params}});
  }
  return {{"sources", sources}, {"stages", stages}};
}

/// Without retries and time limit: those are the submitter's and Slurm's business.
Graph graph_from(const Json& json, const FrozenPrograms& programs) {
  Graph graph;
  for (const Json& source : json.at("sources"))
    graph.sources.push_back({source.at("name"), source.at("kind"), source.at("path").get<std::string>()});
  for (const Json& one : json.at("stages")) {
    PlannedStage stage;
    stage.name = one.at("name");
    stage.program = programs.at(stage.name);
    stage.exe = one.at("exe");
    for (const Json& input : one.at("inputs"))
      stage.inputs.push_back({input.at("role"), input.at("source"), input.at("stage")});
    stage.resources.amounts = one.at("amounts").get<Amounts>();
    stage.params = one.at("params");
    graph.stages.push_back(std::move(stage));
  }
  return graph;
}

}  // namespace sediment::runner::slurm
