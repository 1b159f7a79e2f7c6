#include "pipeline/runner/slurm/work.hpp"

#include <unordered_map>

#include "pipeline/runner/execution/plan.hpp"

namespace sediment::runner::slurm {
namespace {

/// What is known of the stages of one instance, by their index.
struct Known {
  std::vector<std::string> ids;  ///< of their works
  std::vector<std::size_t> works;
  std::vector<std::string> objects;
};

/// The works before a stage take the place of results that nobody has made yet.
std::string work_id(const Instance& instance, std::size_t stage_idx, const Known& known) {
  return key_of(instance.graph->stages[stage_idx], *input_ids(instance, stage_idx, known.ids)).id;
}

Work first_seen(const Instance& instance, std::size_t stage_idx, const Known& known, Store& store) {
  const PlannedStage& stage = instance.graph->stages[stage_idx];
  Work work;
  for (const Input& input : stage.inputs)
    if (input.stage_idx >= 0) work.reads.push_back(known.works[static_cast<std::size_t>(input.stage_idx)]);
  if (const auto ids = input_ids(instance, stage_idx, known.objects)) {
    work.key = key_of(stage, *ids).id;
    work.hit = store.find(work.key);
  }
  return work;
}

}  // namespace

std::vector<Work> works_of(const std::vector<Instance>& instances, Store& store) {
  std::vector<Work> works;
  std::unordered_map<std::string, std::size_t> seen;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    const std::size_t count = instance.graph->stages.size();
    Known known{std::vector<std::string>(count), std::vector<std::size_t>(count),
                std::vector<std::string>(count)};
    for (std::size_t s = 0; s < count; ++s) {
      if (!instance.needed[s]) continue;
      known.ids[s] = work_id(instance, s, known);
      const auto [found, fresh] = seen.try_emplace(known.ids[s], works.size());
      if (fresh) {
        works.push_back(first_seen(instance, s, known, store));
        works.back().id = known.ids[s];
      }
      Work& work = works[found->second];
      work.places.push_back({i, s});
      work.selected = work.selected || instance.selected[s];
      known.works[s] = found->second;
      if (work.hit) known.objects[s] = work.hit->object;
    }
  }
  return works;
}

const PlannedStage& stage_of(const Work& work, const std::vector<Instance>& instances) {
  const Place& place = work.places.front();
  return instances[place.instance_idx].graph->stages[place.stage_idx];
}

std::string label_of(const Work& work, const std::vector<Instance>& instances) {
  const Instance& instance = instances[work.places.front().instance_idx];
  const std::string& stage = stage_of(work, instances).name;
  return instance.name.empty() ? stage : instance.name + '/' + stage;
}

}  // namespace sediment::runner::slurm
