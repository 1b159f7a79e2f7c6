#include "pipeline/runner/commands/look.hpp"

#include "pipeline/contract/errors.hpp"

namespace sediment::runner {
namespace {

std::string quoted(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\n'\"\\$&|;<>()*?[]{}#~`!") == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + '\'';
}

}  // namespace

std::vector<const LookedAt*> Look::named(const std::string& label) const {
  std::vector<const LookedAt*> found;
  std::vector<std::string> labels;
  for (const LookedAt& one : stages) {
    if (label.empty() || one.label == label) found.push_back(&one);
    labels.push_back(one.label);
  }
  if (found.empty())
    throw contract::UsageError("unknown stage \"" + label + "\"" + did_you_mean(label, labels));
  return found;
}

Look look(const Arguments& arguments) {
  Look all{open_config(arguments), {}};
  for (std::size_t i = 0; i < all.opened.instances.size(); ++i) {
    const Instance& instance = all.opened.instances[i];
    const auto last = Workspace(instance.out).read_record().stages;
    std::vector<PlannedTask> tasks = plan(instance, *all.opened.store, arguments.threads);
    for (std::size_t s = 0; s < tasks.size(); ++s) {
      if (tasks[s].state == PlannedTask::State::skipped) continue;
      const std::string& stage = instance.graph->stages[s].name;
      const auto record = last.find(stage);
      all.stages.push_back({instance.name.empty() ? stage : instance.name + '/' + stage, i, s,
                            std::move(tasks[s]),
                            record == last.end() ? std::nullopt : std::optional(record->second)});
    }
  }
  all.opened.store->memory().save();
  return all;
}

const char* name_of(PlannedTask::State state) {
  switch (state) {
    case PlannedTask::State::kept:
      return "kept";
    case PlannedTask::State::runs:
      return "runs";
    case PlannedTask::State::behind:
      return "may run";
    case PlannedTask::State::skipped:
      return "skipped";
  }
  return "";
}

std::string shell_text(const std::vector<std::string>& argv) {
  std::string text;
  for (const std::string& word : argv) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

}  // namespace sediment::runner
