#include "pipeline/runner/execution/instance.hpp"

namespace sediment::runner {

void select_stages(Instance& instance, const std::string& only, const std::string& from,
                   const std::string& until) {
  const Graph& graph = *instance.graph;
  const auto idx_of = [&](const std::string& name) { return name.empty() ? -1 : graph.index_of(name); };
  const int only_idx = idx_of(only), from_idx = idx_of(from), until_idx = idx_of(until);
  const int count = static_cast<int>(graph.stages.size());
  instance.selected.assign(graph.stages.size(), false);
  for (int i = 0; i < count; ++i) {
    const bool is_only = only_idx < 0 || i == only_idx;
    const bool is_from = from_idx < 0 || i == from_idx || graph.is_behind(i, from_idx);
    const bool is_until = until_idx < 0 || i == until_idx || graph.is_behind(until_idx, i);
    instance.selected[static_cast<std::size_t>(i)] = is_only && is_from && is_until;
  }
  instance.needed = instance.selected;
  for (int i = count - 1; i >= 0; --i) {
    if (!instance.needed[static_cast<std::size_t>(i)]) continue;
    for (const Input& input : graph.stages[static_cast<std::size_t>(i)].inputs)
      if (input.stage_idx >= 0) instance.needed[static_cast<std::size_t>(input.stage_idx)] = true;
  }
}

}  // namespace sediment::runner
