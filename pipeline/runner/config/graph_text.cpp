#include "pipeline/runner/config/graph_text.hpp"

#include <fmt/format.h>

namespace sediment::runner {
namespace {

/// Calls edge(from, role, stage) for every input.
template <class Edge>
void for_each_edge(const Graph& graph, const Edge& edge) {
  for (const PlannedStage& stage : graph.stages)
    for (const Input& input : stage.inputs)
      edge(input.source_idx >= 0 ? graph.sources[static_cast<std::size_t>(input.source_idx)].name
                                 : graph.stages[static_cast<std::size_t>(input.stage_idx)].name,
           input.role, stage.name);
}

std::string mermaid(const Graph& graph) {
  std::string text = "flowchart LR\n";
  for (const Source& source : graph.sources)
    if (!source.path.empty()) text += fmt::format("  {}([{}])\n", source.name, source.name);
  for (const PlannedStage& stage : graph.stages) text += fmt::format("  {}[{}]\n", stage.name, stage.name);
  for_each_edge(graph, [&](const auto& from, const auto& role, const auto& to) {
    text += fmt::format("  {} -- {} --> {}\n", from, role, to);
  });
  return text;
}

std::string dot(const Graph& graph) {
  std::string text = "digraph pipeline {\n  rankdir=LR;\n  node [shape=box];\n";
  for (const Source& source : graph.sources)
    if (!source.path.empty()) text += fmt::format("  \"{}\" [shape=ellipse];\n", source.name);
  for_each_edge(graph, [&](const auto& from, const auto& role, const auto& to) {
    text += fmt::format("  \"{}\" -> \"{}\" [label=\"{}\"];\n", from, to, role);
  });
  return text + "}\n";
}

std::string plain(const Graph& graph) {
  std::string text;
  for (const Source& source : graph.sources)
    text += fmt::format("{} ({}): {}\n", source.name, source.kind,
                        source.path.empty() ? "not given" : source.path.string());
  for (const PlannedStage& stage : graph.stages) {
    text += stage.name + '\n';
    for (const Input& input : stage.inputs)
      text +=
          fmt::format("  {} <- {}\n", input.role,
                      input.source_idx >= 0 ? graph.sources[static_cast<std::size_t>(input.source_idx)].name
                                            : graph.stages[static_cast<std::size_t>(input.stage_idx)].name);
  }
  return text;
}

}  // namespace

contract::Json graph_json(const Graph& graph) {
  using contract::Json;
  Json json = {{"sources", Json::array()}, {"stages", Json::array()}};
  for (const Source& source : graph.sources)
    json["sources"].push_back({{"name", source.name}, {"kind", source.kind}, {"path", source.path.string()}});
  for (const PlannedStage& stage : graph.stages)
    json["stages"].push_back({{"name", stage.name}, {"params", stage.params}, {"reads", Json::object()}});
  for_each_edge(graph, [&](const auto& from, const auto& role, const auto& to) {
    json["stages"].at(static_cast<std::size_t>(graph.index_of(to)))["reads"][role] = from;
  });
  return json;
}

std::string graph_text(const Graph& graph, const std::string& format) {
  if (format == "mermaid") return mermaid(graph);
  return format == "dot" ? dot(graph) : plain(graph);
}

}  // namespace sediment::runner
