#include "pipeline/runner/config/graph.hpp"

#include <algorithm>

#include "pipeline/contract/errors.hpp"
#include "pipeline/runner/config/resolve_stages.hpp"

namespace sediment::runner {
namespace {

using contract::UsageError;

std::string joined(const std::vector<std::string>& names, const char* separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

/// One cycle among the stages that are left, as "a -> b -> a".
std::string cycle_in(const std::vector<PlannedStage>& stages, const std::vector<bool>& placed) {
  int at = static_cast<int>(std::find(placed.begin(), placed.end(), false) - placed.begin());
  std::vector<int> path;
  while (std::find(path.begin(), path.end(), at) == path.end()) {
    path.push_back(at);
    for (const Input& input : stages[static_cast<std::size_t>(at)].inputs)
      if (input.stage_idx >= 0 && !placed[static_cast<std::size_t>(input.stage_idx)]) at = input.stage_idx;
  }
  std::vector<std::string> names{stages[static_cast<std::size_t>(at)].name};
  for (auto one = path.rbegin(); one != path.rend(); ++one) {
    names.push_back(stages[static_cast<std::size_t>(*one)].name);
    if (*one == at) break;
  }
  return joined(names, " -> ");
}

/// The stages in an order in which each stands behind those it reads from.
std::vector<PlannedStage> sorted(std::vector<PlannedStage> stages, const PipelineFile& pipeline,
                                 Violations& violations) {
  const std::size_t count = stages.size();
  std::vector<int> new_idx(count, -1);
  std::vector<bool> placed(count, false);
  std::vector<PlannedStage> order;
  while (order.size() < count) {
    const auto is_next = [&](std::size_t i) {
      return !placed[i] &&
             std::all_of(stages[i].inputs.begin(), stages[i].inputs.end(), [&](const Input& in) {
               return in.stage_idx < 0 || placed[static_cast<std::size_t>(in.stage_idx)];
             });
    };
    std::size_t next = 0;
    while (next < count && !is_next(next)) ++next;
    if (next == count) {
      const auto stuck =
          static_cast<std::size_t>(std::find(placed.begin(), placed.end(), false) - placed.begin());
      violations.add(pipeline.stages[stuck].line, "the stages form a cycle: " + cycle_in(stages, placed));
      return order;
    }
    placed[next] = true;
    new_idx[next] = static_cast<int>(order.size());
    order.push_back(stages[next]);
    for (Input& input : order.back().inputs)
      if (input.stage_idx >= 0) input.stage_idx = new_idx[static_cast<std::size_t>(input.stage_idx)];
  }
  return order;
}

}  // namespace

int Graph::index_of(const std::string& stage) const {
  std::vector<std::string> names;
  for (const PlannedStage& one : stages) names.push_back(one.name);
  const auto found = std::find(names.begin(), names.end(), stage);
  if (found == names.end())
    throw UsageError("unknown stage \"" + stage + "\"" + did_you_mean(stage, names) +
                     "; the pipeline has: " + joined(names, ", "));
  return static_cast<int>(found - names.begin());
}

bool Graph::is_behind(int stage_idx, int from_idx) const {
  const auto& inputs = stages[static_cast<std::size_t>(stage_idx)].inputs;
  return std::any_of(inputs.begin(), inputs.end(), [&](const Input& input) {
    return input.stage_idx >= 0 && (input.stage_idx == from_idx || is_behind(input.stage_idx, from_idx));
  });
}

Setting setting_from(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--set " + text + ": expected stage.parameter=value or source=path");
  return {text.substr(0, equals), text.substr(equals + 1), "--set "};
}

Graph resolve(const PipelineFile& pipeline, const std::vector<Setting>& settings, std::vector<Source> sources,
              Programs& programs, Violations& violations) {
  Graph graph;
  graph.sources = std::move(sources);
  graph.stages =
      sorted(resolve_stages(pipeline, settings, graph.sources, programs, violations), pipeline, violations);
  return graph;
}

}  // namespace sediment::runner
