#include "pipeline/runner/execution/task.hpp"

namespace sediment::runner {

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::open:
      return "not run";
    case Outcome::kept:
      return "kept";
    case Outcome::ran:
      return "ran";
    case Outcome::failed:
      return "failed";
    case Outcome::blocked:
      return "blocked";
    case Outcome::interrupted:
      return "interrupted";
    case Outcome::skipped:
      return "skipped";
  }
  return "";
}

std::vector<Task> tasks_of(const std::vector<Instance>& instances) {
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    const auto& stages = instance.graph->stages;
    const std::size_t first = tasks.size();
    for (std::size_t s = 0; s < stages.size(); ++s) {
      Task task;
      task.label = instance.name.empty() ? stages[s].name : instance.name + '/' + stages[s].name;
      task.instance_idx = i;
      task.stage_idx = s;
      if (!instance.needed[s]) task.outcome = Outcome::skipped;
      for (const Input& input : stages[s].inputs) {
        if (input.stage_idx < 0 || !instance.needed[s]) continue;
        ++task.waits_for;
        tasks[first + static_cast<std::size_t>(input.stage_idx)].dependents.push_back(tasks.size());
      }
      tasks.push_back(std::move(task));
    }
  }
  return tasks;
}

}  // namespace sediment::runner
