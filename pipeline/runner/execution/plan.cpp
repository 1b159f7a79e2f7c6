#include "pipeline/runner/execution/plan.hpp"

#include <algorithm>

#include "pipeline/runner/execution/attempt.hpp"

namespace sediment::runner {

namespace fs = std::filesystem;
using contract::Json;

Reason reason_for(const Key& key, const StageRecord* last, const Store& store) {
  if (last == nullptr) return {"first run", {}};
  if (last->key.empty()) return {last->state == "failed" ? "it failed" : "first run", {}};
  if (last->key == key.id) return {"its result is lost or damaged", {}};
  const auto receipt = store.receipt(last->key);
  if (!receipt) return {"its last receipt is lost", {}};
  Reason reason{"", differences(receipt->parts, Json::parse(key.text))};
  reason.text = in_short(reason.differences);
  return reason;
}

std::optional<std::vector<std::string>> input_ids(const Instance& instance, std::size_t stage_idx,
                                                  const std::vector<std::string>& objects) {
  std::vector<std::string> ids;
  for (const Input& input : instance.graph->stages[stage_idx].inputs) {
    const std::string& id = input.source_idx >= 0
                                ? instance.source_ids[static_cast<std::size_t>(input.source_idx)]
                                : objects[static_cast<std::size_t>(input.stage_idx)];
    if (id.empty()) return std::nullopt;
    ids.push_back(id);
  }
  return ids;
}

std::vector<fs::path> input_paths(const Instance& instance, std::size_t stage_idx,
                                  const std::vector<std::string>& objects, const Store& store) {
  std::vector<fs::path> paths;
  for (const Input& input : instance.graph->stages[stage_idx].inputs) {
    const auto stage = static_cast<std::size_t>(input.stage_idx);
    if (input.source_idx >= 0)
      paths.push_back(instance.source_paths[static_cast<std::size_t>(input.source_idx)]);
    else
      paths.push_back(objects[stage].empty() ? instance.out / instance.graph->stages[stage].name
                                             : store.object_path(objects[stage]));
  }
  return paths;
}

std::vector<PlannedTask> plan(const Instance& instance, Store& store, int threads) {
  const auto& stages = instance.graph->stages;
  const auto last = Workspace(instance.out).read_record().stages;
  std::vector<PlannedTask> tasks(stages.size());
  std::vector<std::string> objects(stages.size());
  for (std::size_t i = 0; i < stages.size(); ++i) {
    PlannedTask& task = tasks[i];
    if (!instance.needed[i]) continue;
    task.argv =
        argv_of(stages[i], input_paths(instance, i, objects, store), instance.out / stages[i].name, threads);
    const auto ids = input_ids(instance, i, objects);
    if (!ids) {
      task.state = PlannedTask::State::behind;
      for (const Input& input : stages[i].inputs)
        if (input.stage_idx >= 0 && objects[static_cast<std::size_t>(input.stage_idx)].empty())
          task.why.text += (task.why.text.empty() ? "behind " : ", ") +
                           stages[static_cast<std::size_t>(input.stage_idx)].name;
      continue;
    }
    task.key = key_of(stages[i], *ids);
    task.hit = store.find(task.key->id);
    task.state = task.hit ? PlannedTask::State::kept : PlannedTask::State::runs;
    if (task.hit) objects[i] = task.hit->object;
    const auto record = last.find(stages[i].name);
    if (!task.hit) task.why = reason_for(*task.key, record == last.end() ? nullptr : &record->second, store);
    if (!task.hit && !instance.selected[i]) task.why.text += " (not selected: a run would stop here)";
  }
  return tasks;
}

}  // namespace sediment::runner
